// The rules of a drawing: a list with the miss of each rule, and new rules by clicking regions.

import { signal } from "@preact/signals";
import type { RuleAsk, RuleResult, RulesAsk } from "../messages";
import * as store from "../store";
import { Icon } from "./icons";

type Kind = RuleAsk["kind"];

/** For each kind: its name, a hint, the sign between its regions, and the least number of regions. */
export const KINDS: Record<Kind, { name: string; ask: string; sign: string; least: number }> = {
  lighter: { name: "Lighter", ask: "click regions, the lightest first", sign: " › ", least: 2 },
  lightness: { name: "Steps", ask: "click shades, the lightest first: 15 units apart", sign: " › ", least: 2 },
  "same-chroma": { name: "Shades", ask: "click the shades of one colour", sign: " · ", least: 2 },
  "same-hue": { name: "One hue", ask: "click regions of one hue, strong or pale", sign: " · ", least: 2 },
  muted: { name: "Muted", ask: "click regions that stay near grey", sign: " · ", least: 1 },
};

/** The rule that the user is making. */
export const ruling = signal<{ kind: Kind; regions: string[]; most: number } | null>(null);

export function present(): RulesAsk {
  const view = store.view.value;
  return view?.ask.rules ?? view?.model?.rules ?? {};
}
const set = (rules: RuleAsk[]): void => store.ask({ rules: { ...present(), rules } });

/** Adds a clicked region to the rule that the user is making, or selects the region. */
export function clickRegion(name: string | null): void {
  const rule = ruling.value;
  if (rule === null) store.level.value = name === store.level.value ? null : name;
  else if (name !== null && !rule.regions.includes(name)) ruling.value = { ...rule, regions: [...rule.regions, name] };
}

export function addRule(): void {
  const rule = ruling.value;
  if (rule === null) return;
  ruling.value = null;
  set([...(present().rules ?? []), { kind: rule.kind, regions: rule.regions, ...(rule.kind === "muted" ? { most: rule.most } : {}) }]);
}

/** Selects the reports on a rule: one for each neighbouring pair, or for each region. */
function reportsOn(rule: RuleAsk, reports: RuleResult[]): RuleResult[] {
  const ofKind = reports.filter(({ kind }) => kind === rule.kind);
  if (rule.kind === "muted") {
    const named = new Set((present().rules ?? []).flatMap(({ kind, regions }) => (kind === "muted" ? regions : [])));
    return ofKind.filter(({ first }) => rule.regions.includes(first) || (rule.regions.includes("all") && !named.has(first)));
  }
  return ofKind.filter(({ first, second }) => {
    const at = rule.regions.indexOf(first);
    return at >= 0 && rule.regions[at + 1] === second;
  });
}

export function Rules() {
  const region = store.level.value;
  const all = present().rules ?? [];
  const visible = all.filter(({ regions }) => !region || regions.includes(region));
  const reports = store.palette.value?.rules ?? [];
  const missed = reports.filter(({ holds }) => !holds).length;
  return (
    <section class="rules" aria-label="Rules">
      <h2>{region ? `Rules of ${region}` : "Rules"}</h2>
      {reports.length > 0 && !region && (
        <p class={missed ? "verdict short" : "verdict"}>
          {missed === 0 ? `all ${reports.length} hold` : `${missed} of ${reports.length} missed`}
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
        {visible
          .map((rule) => ({ rule, rows: reportsOn(rule, reports) }))
          .sort((a, b) => worst(b.rows) - worst(a.rows))
          .map(({ rule, rows }) => (
            <Row key={`${rule.kind} ${rule.regions.join()}`} rule={rule} reports={rows} />
          ))}
      </ul>
    </section>
  );
}

/** The largest miss of a rule; 0 if it holds, so that rules that hold keep their order. */
const worst = (reports: RuleResult[]): number =>
  Math.max(0, ...reports.filter(({ holds }) => !holds).map(({ residual }) => residual));

function Row({ rule, reports }: { rule: RuleAsk; reports: RuleResult[] }) {
  const colors = store.palette.value?.colors ?? {};
  const rest = (present().rules ?? []).filter((other) => other !== rule);
  const far = Math.max(0, ...reports.map(({ residual }) => residual));
  const missed = reports.filter(({ holds }) => !holds);
  const sign = KINDS[rule.kind].sign;
  return (
    <li class={missed.length > 0 ? "rule missed" : "rule"} title={reports.map(({ text }) => plain(text)).join("\n")}>
      <span class="kind">{KINDS[rule.kind].name}</span>
      <span class="chips" aria-hidden="true">
        {rule.regions.map((name) => (
          <Chip key={name} color={colors[name]} />
        ))}
      </span>
      <span class={missed.length > 0 ? "far short" : "far"}>{reports.length === 0 ? "" : missed.length === 0 ? "holds" : `${far.toFixed(0)} off`}</span>
      <button
        class="icon-button tiny"
        title={`Remove the rule: ${KINDS[rule.kind].name}, ${rule.regions.join(", ")}`}
        onClick={() => set(rest)}
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
            aria-label={`Largest distance from grey of ${rule.regions.join(", ")}`}
            onChange={(event) => {
              const most = Number(event.currentTarget.value);
              set((present().rules ?? []).map((other) => (other === rule ? { ...rule, most } : other)));
            }}
          />
          <output>{rule.most}</output>
        </label>
      ) : null}
      {missed.length > 0 && <span class="residual">{missed.map(({ text }) => plain(text)).join("; ")}</span>}
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
