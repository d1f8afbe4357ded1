// The right side: the selected part, its place in the source, its choices.

import { useState } from "preact/hooks";
import type { ChoiceInfo, Place } from "../messages";
import * as store from "../store";
import { isBelow } from "../view";
import { Balance } from "./balance";
import { Field } from "./fields";
import { Icon } from "./icons";

const SHOWN = 150;

export function Inspector() {
  const view = store.view.value;
  const active = store.active.value;
  const level = store.level.value;
  const described = store.described.value;
  if (view === null || active === null || described === null || !store.sameKey(described.key, active.key)) {
    return (
      <aside class="side right" aria-label="Part">
        <section>
          <h2>Part</h2>
          <p class="quiet">{active === null ? "Grow a result, then click a part." : "…"}</p>
        </section>
      </aside>
    );
  }
  const here = level ?? "";
  const choices = described.choices.filter(({ address }) => isBelow(address, here));
  const count = described.parts.filter(({ address }) => isBelow(address, here)).length;
  const place = described.parts.find(({ address }) => address === store.part.value)?.place ?? null;
  return (
    <aside class="side right" aria-label="Part">
      <section>
        <h2>{level === null ? "Whole" : "Part"}</h2>
        <Levels here={here} />
        <p class="quiet">
          {count} {count === 1 ? "piece" : "pieces"}, {choices.length} {choices.length === 1 ? "choice" : "choices"}
        </p>
        {place !== null && <Source place={place} />}
        {here !== "" && (
          <div class="actions">
            <button class="button" onClick={() => store.reroll(here, 1)} title="Grow this part again (R)">
              <Icon name="dice" /> Re-roll
            </button>
            <button class="button" onClick={() => store.reroll(here, 12)} title="Twelve other forms of this part">
              Variants
            </button>
            <button
              class="button"
              aria-pressed={store.heldParts.value.has(here)}
              onClick={() => store.holdOrFree(here)}
              title="Hold this part in further searches (H)"
            >
              <Icon name="pin" filled={store.heldParts.value.has(here)} /> {store.heldParts.value.has(here) ? "Free" : "Hold"}
            </button>
          </div>
        )}
        {here !== "" && (
          <label class="row" title="Difference between the variants and this part">
            <span>variants</span>
            <input
              type="range"
              min={0}
              max={1}
              step={0.25}
              value={store.strength.value}
              aria-label="Difference of variants"
              onInput={(event) => (store.strength.value = Number(event.currentTarget.value))}
            />
            <output>{["alike", "near", "some", "far", "unlike"][Math.round(4 * store.strength.value)]}</output>
          </label>
        )}
      </section>
      <Unmet texts={active.unmet} />
      {store.kind.value === "structure" && <Balance />}
      <section class="choices" aria-label="Choices">
        {grouped(choices.slice(0, SHOWN), here).map(([call, members]) => (
          <div key={call} role="group" aria-label={call === here ? "Choices of the part itself" : headOf(call, here)}>
            {call !== here && (
              <button
                class="call"
                title={`Select ${store.labelOf(call)}: ${call}`}
                onClick={() => (store.level.value = call)}
                onMouseEnter={() => (store.hovered.value = call)}
                onMouseLeave={() => (store.hovered.value = null)}
              >
                {headOf(call, here)}
              </button>
            )}
            {members.map((choice) => (
              <Choice key={choice.address} choice={choice} />
            ))}
          </div>
        ))}
        {choices.length > SHOWN && <p class="quiet">{choices.length - SHOWN} more choices: select a smaller part to see them.</p>}
      </section>
    </aside>
  );
}

/** What a result does not keep of the requirements beside its model. */
function Unmet({ texts }: { texts: string[] }) {
  if (texts.length === 0) return null;
  return (
    <section aria-label="Requirements">
      <h2>Requirements</h2>
      <p class="quiet">This result does not keep requirements.toml:</p>
      {texts.map((text) => (
        <p key={text} class="warning">
          {text}
        </p>
      ))}
    </section>
  );
}

/** The label of a group of choices, as a heading. */
const headOf = (call: string, here: string): string => store.capital(store.labelBelow(call, here));

/** The calls around the selection, outermost first. */
function Levels({ here }: { here: string }) {
  const steps = here === "" ? [] : here.split("/");
  const name = store.view.value?.model?.reference.replace(/^.*[/:]/, "") ?? "";
  return (
    <nav class="levels" aria-label="Calls">
      <button aria-current={here === ""} onClick={() => (store.level.value = "")}>
        {name}
      </button>
      {steps.map((_, k) => {
        const address = steps.slice(0, k + 1).join("/");
        const around = steps.slice(0, k).join("/");
        const next = steps.slice(0, k + 2).join("/");
        // An iteration and the only call in it have the same label.
        if (address !== here && store.labelOf(address) === store.labelOf(next)) return null;
        return (
          <button
            key={address}
            title={address}
            aria-current={address === here}
            onClick={() => (store.level.value = address)}
            onMouseEnter={() => (store.hovered.value = address)}
            onMouseLeave={() => (store.hovered.value = null)}
          >
            {store.labelBelow(address, around)}
          </button>
        );
      })}
    </nav>
  );
}

function Source({ place }: { place: Place }) {
  const file = place.path.replace(/^.*\//, "");
  return (
    <p class="source" title={place.path}>
      {file}:{place.line}
    </p>
  );
}

/** Groups choices by the addresses of their calls; the selection's own choices come first. */
function grouped(choices: ChoiceInfo[], here: string): [string, ChoiceInfo[]][] {
  const groups = new Map<string, ChoiceInfo[]>([[here, []]]);
  for (const choice of choices) {
    const call = choice.address.split("/").slice(0, -1).join("/");
    groups.set(call, [...(groups.get(call) ?? []), choice]);
  }
  return [...groups].filter(([, members]) => members.length > 0);
}

function Choice({ choice }: { choice: ChoiceInfo }) {
  const name = store.labelBelow(choice.address, choice.address.split("/").slice(0, -1).join("/"));
  const [moving, setMoving] = useState<number | null>(null);
  const isBoolean = typeof choice.value === "boolean";
  const isHeld = store.heldParts.value.has(choice.address);
  const set = (value: number | boolean | string, phase: "move" | "end") =>
    void store.tell({ kind: "choose", address: choice.address, value, phase });
  const step = choice.is_whole ? 1 : ((choice.high ?? 1) - (choice.low ?? 0)) / 200;
  const where = choice.place === null ? "" : `, line ${choice.place.line}`;
  return (
    <div class="choice">
      <label title={`${store.labelOf(choice.address)}\n${choice.address}: ${choice.family}${where}`}>
        <span>{name}</span>
        {isBoolean ? (
          <input
            type="checkbox"
            checked={choice.value}
            onChange={(event) => set(event.currentTarget.checked, "end")}
          />
        ) : choice.options.length > 0 ? (
          <select value={choice.value} onChange={(event) => set(event.currentTarget.value, "end")}>
            {choice.options.map((option) => (
              <option key={option}>{option}</option>
            ))}
          </select>
        ) : choice.low === null ? null : (
          <Field
            type="range"
            min={choice.low}
            max={choice.high ?? undefined}
            step={step || "any"}
            value={choice.value}
            onMove={(text) => {
              setMoving(Number(text));
              set(Number(text), "move");
            }}
            onEnd={(text) => {
              setMoving(null);
              set(Number(text), "end");
            }}
          />
        )}
        {choice.options.length === 0 && <output>{shown(moving ?? choice.value)}</output>}
      </label>
      <button
        class="icon-button tiny"
        aria-pressed={isHeld}
        title={`${isHeld ? "Free" : "Hold"} ${store.labelOf(choice.address)}`}
        onClick={() => store.holdOrFree(choice.address)}
      >
        <Icon name="pin" filled={isHeld} />
      </button>
    </div>
  );
}

const shown = (value: unknown): string =>
  typeof value === "number" && !Number.isInteger(value) ? value.toFixed(Math.abs(value) < 10 ? 2 : 1) : String(value);
