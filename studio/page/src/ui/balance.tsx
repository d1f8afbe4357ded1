// The balance of a structure: whether it stands, its margin, and the boards for cutting its pieces.

import { useState } from "preact/hooks";
import * as store from "../store";

export function Balance() {
  const judged = store.judged.value;
  const [isBusy, setBusy] = useState(false);
  const key = store.picked.value;
  const simulate = async () => {
    if (key === null) return;
    setBusy(true);
    await store.tell({ kind: "judge", key, simulate: true });
    setBusy(false);
  };
  return (
    <section class="balance" aria-label="Balance">
      <h2>Balance</h2>
      {judged === null ? (
        <p class="quiet">…</p>
      ) : (
        <>
          <p class={judged.holds && judged.stands !== false ? "verdict" : "verdict short"}>
            {judged.holds && judged.stands !== false ? "Stands" : "Falls"}
          </p>
          <p class="quiet">{judged.text}</p>
          <div class="actions">
            <button class="button" onClick={() => void simulate()} disabled={isBusy} title="Simulate the structure for five seconds">
              {isBusy ? "Simulating…" : "Simulate"}
            </button>
            <button class="button" title="Show the forces between blocks" aria-pressed={store.showForces.value} onClick={() => (store.showForces.value = !store.showForces.value)}>
              Forces
            </button>
          </div>
          <Boards thickness={judged.board} />
        </>
      )}
    </section>
  );
}

function Boards({ thickness }: { thickness: number | null }) {
  if (thickness === null) return <p class="quiet">The pieces cannot be cut: not all blocks are flat outlines of one thickness.</p>;
  const names = ["width", "height", "kerf"] as const;
  return (
    <div class="boards" role="group" aria-label={`Boards of ${thickness.toFixed(0)} mm`}>
      <h2>Cut from boards of {thickness.toFixed(0)} mm</h2>
      <div class="fields">
        {names.map((name, k) => (
          <label key={name}>
            <span>{name}</span>
            <input
              type="number"
              min={k === 2 ? 0 : 1}
              step={k === 2 ? 0.05 : 10}
              value={store.board.value[k]}
              onChange={(event) => {
                const value = Number(event.currentTarget.value);
                if (value > 0 || (k === 2 && value === 0)) {
                  store.board.value = store.board.value.map((old, at) => (at === k ? value : old)) as [number, number, number];
                }
              }}
            />
          </label>
        ))}
        <span class="quiet">mm</span>
      </div>
      <div class="actions">
        <button class="button small" onClick={() => void store.download("dxf")}>DXF</button>
        <button class="button small" onClick={() => void store.download("svg")}>SVG</button>
        <button class="button small" onClick={() => void store.download("assembly")}>Plan</button>
      </div>
    </div>
  );
}
