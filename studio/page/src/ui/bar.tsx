// The bar at the top: undo and redo, tools, export, theme.

import * as store from "../store";
import { Icon } from "./icons";
import { Menu } from "./menu";

const FORMATS = [
  ["glb", "GLB", "for Blender, engines, the web"],
  ["stl", "STL", "for 3D printing"],
  ["obj", "OBJ", "for other programs"],
  ["png", "PNG", "a picture"],
  ["json", "Recipe", "run.json, for niwaki replay"],
] as const;

const MORE = {
  structure: [["dxf", "DXF", "boards to cut"], ["svg", "SVG", "boards to cut"], ["assembly", "Plan", "a drawing of the assembly"], ...FORMATS],
  coloring: [["svg", "SVG", "the drawing"], ["png", "PNG", "a picture"], ["toml", "Rules", "rules.toml, for niwaki color"]],
} as const;

export function Bar({ onFit }: { onFit: () => void }) {
  const view = store.view.value;
  const isFlat = view?.model?.draws != null;
  const kind = store.kind.value;
  const formats = kind !== "scene" ? MORE[kind] : isFlat ? ([["svg", "SVG", "the drawing"], ...FORMATS.slice(3)] as const) : FORMATS;
  return (
    <header class="bar">
      <span class="mark">Niwaki</span>
      <div class="group" role="group" aria-label="History">
        <button class="icon-button" title="Undo (Ctrl Z)" disabled={!view?.undo} onClick={() => store.tell({ kind: "undo" })}>
          <Icon name="undo" />
        </button>
        <button class="icon-button" title="Redo (Ctrl Shift Z)" disabled={!view?.redo} onClick={() => store.tell({ kind: "redo" })}>
          <Icon name="redo" />
        </button>
      </div>
      <div class="group" role="group" aria-label="View">
        <button class="icon-button" title="Fit the scene into the view (F)" onClick={onFit}>
          <Icon name="fit" />
        </button>
        {kind === "scene" && (
          <>
            <button
              class="icon-button"
              title="Show the target (T)"
              aria-pressed={store.showGhost.value}
              onClick={() => (store.showGhost.value = !store.showGhost.value)}
            >
              <Icon name="ghost" />
            </button>
            <button
              class="icon-button"
              title="Show the difference from the target (X)"
              aria-pressed={store.showDifference.value}
              disabled={store.picked.value === null}
              onClick={() => (store.showDifference.value = !store.showDifference.value)}
            >
              <Icon name="difference" />
            </button>
            <button
              class="icon-button"
              title="Compare starred results (C)"
              aria-pressed={store.compared.value.length > 0}
              disabled={!view?.stars.length}
              onClick={store.compare}
            >
              <Icon name="compare" />
            </button>
            <button
              class="icon-button"
              title="Draw a silhouette to grow into (D)"
              aria-pressed={store.tool.value === "draw"}
              onClick={() => (store.tool.value = store.tool.value === "draw" ? "look" : "draw")}
            >
              <Icon name="pen" />
            </button>
          </>
        )}
      </div>
      <span class="grow" />
      <button
        class="icon-button"
        title={store.theme.value === "light" ? "Dark theme" : "Light theme"}
        onClick={() => (store.theme.value = store.theme.value === "light" ? "dark" : "light")}
      >
        <Icon name={store.theme.value === "light" ? "moon" : "sun"} />
      </button>
      <Menu
        look="button"
        face={
          <>
            <Icon name="save" /> Export
          </>
        }
        isDisabled={store.picked.value === null}
        items={formats.map(([format, name, use]) => ({ name, use, act: () => void store.download(format) }))}
      />
    </header>
  );
}
