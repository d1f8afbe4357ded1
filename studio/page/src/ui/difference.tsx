// The legend of the difference from the target: colours, cells, and the fit.

import * as store from "../store";
import { KINDS } from "../view";

const NAMES = ["covered", "missing", "outside"] as const;
const css = (color: number): string => `#${color.toString(16).padStart(6, "0")}`;

export function Legend() {
  const difference = store.difference.value;
  if (!store.showDifference.value || difference === null) return null;
  const counts = store.counts.value;
  const colors = KINDS[store.theme.value];
  const outcome = store.view.value?.results.find(({ key }) => store.sameKey(key, difference.header.key));
  return (
    <div class="legend" role="status" aria-label="Difference from the target">
      {NAMES.map((name, k) => (
        <span key={name}>
          <i class="swatch" data-kind={name} ref={(swatch) => void swatch?.style.setProperty("background", css(colors[k + 1]))} />
          {name} <b>{counts[name].toLocaleString("en")}</b>
        </span>
      ))}
      {outcome !== undefined && <span class="quiet">{outcome.fit}</span>}
    </div>
  );
}
