// The legend of the difference from the target: colours, cells, and the two shares.

import * as store from "../store";
import { KINDS } from "../view";

const NAMES = ["covered", "missing", "outside"] as const;
const css = (color: number): string => `#${color.toString(16).padStart(6, "0")}`;

export function Legend() {
  const difference = store.difference.value;
  if (!store.showDifference.value || difference === null) return null;
  const counts = store.counts.value;
  const colors = KINDS[store.theme.value];
  const share = (a: number, b: number) => (a + b === 0 ? "0" : ((100 * a) / (a + b)).toFixed(1));
  return (
    <div class="legend" role="status" aria-label="Difference from the target">
      {NAMES.map((name, k) => (
        <span key={name}>
          <i class="swatch" data-kind={name} ref={(swatch) => void swatch?.style.setProperty("background", css(colors[k + 1]))} />
          {name} <b>{counts[name].toLocaleString("en")}</b>
        </span>
      ))}
      <span class="quiet">
        {share(counts.covered, counts.missing)} % of the {difference.header.is_picture ? "picture" : "target"} covered,{" "}
        {share(counts.outside, counts.covered)} % of the model outside
      </span>
    </div>
  );
}
