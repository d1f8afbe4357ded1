// The rules of a drawing: which there are, how far each is from being met, and a new one by clicking regions.

import { signal } from "@preact/signals";
import type { KeptRule, RuleAsk, RulesAsk } from "../messages";
import * as store from "../store";
import { Icon } from "./icons";

type Kind = RuleAsk["kind"];

/** For each kind its name, what to click, what stands between its regions, and how many it needs. */
export const KINDS: Record<Kind, { name: string; ask: string; sign: string; least: number }> = {
  lighter: { name: "Lighter", ask: "click regions, the lightest first", sign: " › ", least: 2 },
  lightness: { name: "Steps", ask: "click shades, the lightest first: 15 units apart", sign: " › ", least: 2 },
  "same-chroma": { name: "Shades", ask: "click the shades of one colour", sign: " · ", least: 2 },
  "same-hue": { name: "One hue", ask: "click regions of one hue, strong or pale", sign: " · ", least: 2 },
  muted: { name: "Muted", ask: "click regions that stay near grey", sign: " · ", least: 1 },
};

/** The rule that is being made. */
export const ruling = signal<{ kind: Kind; regions: string[]; most: number } | null>(null);

export function asked(): RulesAsk {
  const view = store.view.value;
  return view?.ask.rules ?? view?.model?.rules ?? {};
}
const set = (rules: RuleAsk[]): void => store.ask({ rules: { ...asked(), rules } });

/** A region was clicked: it belongs to the rule that is being made, or is selected. */
export function clicked(name: string | null): void {
  const rule = ruling.value;
  if (rule === null) store.level.value = name === store.level.value ? null : name;
  else if (name !== null && !rule.regions.includes(name)) ruling.value = { ...rule, regions: [...rule.regions, name] };
}

export function addRule(): void {
  const rule = ruling.value;
  if (rule === null) return;
  ruling.value = null;
  set([...(asked().rules ?? []), { kind: rule.kind, regions: rule.regions, ...(rule.kind === "muted" ? { most: rule.most } : {}) }]);
}

/** How well the picked result keeps a rule: a row for each neighbouring pair, or for each region. */
function rowsOf(rule: RuleAsk, kept: KeptRule[]): KeptRule[] {
  const own = kept.filter((one) => one.kind === rule.kind);
  if (rule.kind === "muted") {
    const named = new Set((asked().rules ?? []).flatMap((one) => (one.kind === "muted" ? one.regions : [])));
    return own.filter((one) => rule.regions.includes(one.first) || (rule.regions.includes("all") && !named.has(one.first)));
  }
  return own.filter((one) => {
    const at = rule.regions.indexOf(one.first);
    return at >= 0 && rule.regions[at + 1] === one.second;
  });
}

export function Rules() {
  const region = store.level.value;
  const all = asked().rules ?? [];
  const about = all.filter((one) => !region || one.regions.includes(region));
  const kept = store.palette.value?.kept ?? [];
  const missed = kept.filter((one) => !one.holds).length;
  return (
    <section class="rules" aria-label="Rules">
      <h2>{region ? `Rules of ${region}` : "Rules"}</h2>
      {kept.length > 0 && !region && (
        <p class={missed ? "verdict short" : "verdict"}>
          {missed === 0 ? `all ${kept.length} hold` : `${missed} of ${kept.length} missed`}
        </p>
      )}
      {store.view.value?.note && <p class="warning">{plain(store.view.value.note)}</p>}
      <div class="actions" role="group" aria-label="Add a rule">
        {(Object.keys(KINDS) as Kind[]).map((kind) => (
          <button
            key={kind}
            class="button small"
            aria-pressed={ruling.value?.kind === kind}
            title={`${KINDS[kind].name}: ${KINDS[kind].ask}`}
            onClick={() => (ruling.value = { kind, regions: region ? [region] : [], most: 30 })}
          >
            {KINDS[kind].name}
          </button>
        ))}
      </div>
      <ul class="rows">
        {about
          .map((rule) => ({ rule, kept: rowsOf(rule, kept) }))
          .sort((a, b) => worst(b.kept) - worst(a.kept))
          .map(({ rule, kept }) => (
            <Row key={`${rule.kind} ${rule.regions.join()}`} rule={rule} kept={kept} />
          ))}
      </ul>
    </section>
  );
}

/** How far a rule is missed; 0 where it holds, so that those stay in their order. */
const worst = (kept: KeptRule[]): number => Math.max(0, ...kept.filter((one) => !one.holds).map((one) => one.residual));

function Row({ rule, kept }: { rule: RuleAsk; kept: KeptRule[] }) {
  const colors = store.palette.value?.colors ?? {};
  const others = (asked().rules ?? []).filter((one) => one !== rule);
  const far = Math.max(0, ...kept.map((one) => one.residual));
  const missed = kept.filter((one) => !one.holds);
  const sign = KINDS[rule.kind].sign;
  return (
    <li class={missed.length > 0 ? "rule missed" : "rule"} title={kept.map((one) => plain(one.text)).join("\n")}>
      <span class="kind">{KINDS[rule.kind].name}</span>
      <span class="chips" aria-hidden="true">
        {rule.regions.map((name) => (
          <Chip key={name} color={colors[name]} />
        ))}
      </span>
      <span class={missed.length > 0 ? "far short" : "far"}>{kept.length === 0 ? "" : missed.length === 0 ? "holds" : `${far.toFixed(0)} off`}</span>
      <button
        class="icon-button tiny"
        title={`Take away: ${KINDS[rule.kind].name}, ${rule.regions.join(", ")}`}
        onClick={() => set(others)}
      >
        <Icon name="close" />
      </button>
      <span class="names">{rule.regions.join(sign)}</span>
      {rule.kind === "muted" ? (
        <label class="most">
          <input
            type="range"
            min={0}
            max={100}
            value={rule.most}
            aria-label={`How far from grey ${rule.regions.join(", ")} may be`}
            onChange={(event) => {
              const most = Number(event.currentTarget.value);
              set((asked().rules ?? []).map((one) => (one === rule ? { ...rule, most } : one)));
            }}
          />
          <output>{rule.most}</output>
        </label>
      ) : null}
      {missed.length > 0 && <span class="residual">{missed.map((one) => plain(one.text)).join("; ")}</span>}
    </li>
  );
}

export function Chip({ color }: { color: string | undefined }) {
  return (
    <svg class="chip" viewBox="0 0 10 10" aria-hidden="true">
      <rect width="10" height="10" rx="2.5" fill={color ?? "none"} />
    </svg>
  );
}

const plain = (text: string): string => text.replace(/`/g, "");
