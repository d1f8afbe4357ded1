// The right side for a drawing: the colours of its regions, held regions, and the rules.

import * as store from "../store";
import { Icon } from "./icons";
import { clickRegion, Rules } from "./rules";

export function Palette() {
  const view = store.view.value;
  const model = view?.model;
  if (view === null || model == null) return <aside class="side right" aria-label="Colours" />;
  const held = new Map(view.held.map(({ part, choices }) => [part, choices[part] as string]));
  const colors = store.palette.value?.colors ?? {};
  return (
    <aside class="side right" aria-label="Colours">
      <section>
        <h2>Colours</h2>
        <ul class="regions">
          {model.regions.map(({ name, color }) => (
            <Region key={name} name={name} color={colors[name] ?? held.get(name) ?? color} isHeld={store.heldParts.value.has(name)} />
          ))}
        </ul>
        {model.regions.length === 0 && <p class="quiet">…</p>}
      </section>
      <Rules />
    </aside>
  );
}

function Region({ name, color, isHeld }: { name: string; color: string; isHeld: boolean }) {
  const isSelected = store.level.value === name;
  const setColor = async (value: string) => {
    if (store.picked.value !== null) await store.tell({ kind: "choose", address: name, value });
    await store.tell({ kind: "hold", parts: [name], color: value });
  };
  return (
    <li
      class={isSelected ? "region selected" : "region"}
      onMouseEnter={() => (store.hovered.value = name)}
      onMouseLeave={() => (store.hovered.value = null)}
    >
      <input
        type="color"
        value={color}
        aria-label={`Colour of ${name}`}
        title={`${name}: ${color}. Choose a colour and hold it.`}
        onInput={(event) => {
          if (store.picked.value === null) return;
          void store.tell({ kind: "choose", address: name, value: event.currentTarget.value, phase: "move" });
        }}
        onChange={(event) => void setColor(event.currentTarget.value)}
      />
      <button class="name" aria-pressed={isSelected} onClick={() => clickRegion(name)}>
        {name}
      </button>
      <button
        class="icon-button tiny"
        aria-pressed={isHeld}
        title={isHeld ? `Free ${name}` : `Hold ${name}`}
        disabled={!isHeld && store.picked.value === null}
        onClick={() => store.holdOrFree(name)}
      >
        <Icon name="pin" filled={isHeld} />
      </button>
    </li>
  );
}
