// The page of Niwaki's studio.

import { render } from "preact";
import { useEffect, useState } from "preact/hooks";
import "./style.css";
import { easel, placeOf, plan } from "./pictures";
import * as store from "./store";
import { Bar } from "./ui/bar";
import { Canvas, drag, shown, stage } from "./ui/canvas";
import { sideShapes } from "./ui/compare";
import { Easel, frame } from "./ui/easel";
import { Gallery } from "./ui/gallery";
import { play } from "./ui/growth";
import { Inspector } from "./ui/inspector";
import { Lost } from "./ui/notices";
import { Palette } from "./ui/palette";
import { ruling } from "./ui/rules";
import { Setup } from "./ui/setup";
import { later, warm } from "./view";

function App() {
  const [isDropping, setDropping] = useState(false);
  useEffect(() => {
    addEventListener("keydown", onKey);
    return () => removeEventListener("keydown", onKey);
  }, []);
  const isColoring = store.kind.value === "coloring";
  return (
    <div
      class={`app${isDropping ? " dropping" : ""}${isColoring ? " coloring" : ""}`}
      onDragOver={(event) => {
        event.preventDefault();
        setDropping(true);
      }}
      onDragLeave={() => setDropping(false)}
      onDrop={(event) => {
        event.preventDefault();
        setDropping(false);
        const file = event.dataTransfer?.files[0];
        if (file) void store.upload(file);
      }}
    >
      {/* Without the studio nothing but looking at the scene works. */}
      <div class="contents" inert={store.isLost.value}>
        <Bar onFit={() => stage.fit()} />
        <Setup />
      </div>
      <Canvas />
      {isColoring && <Easel />}
      <div class="contents" inert={store.isLost.value}>
        <Gallery />
        {isColoring ? <Palette /> : <Inspector />}
      </div>
      <Lost />
    </div>
  );
}

function onKey(event: KeyboardEvent): void {
  const target = event.target as HTMLElement;
  const isTyping = /^(INPUT|SELECT|TEXTAREA)$/.test(target.tagName) && (target as HTMLInputElement).type !== "range";
  const isCommand = event.ctrlKey || event.metaKey;
  const level = store.level.value;
  if (isCommand && event.key.toLowerCase() === "z") {
    event.preventDefault();
    void store.tell({ kind: event.shiftKey ? "redo" : "undo" });
    return;
  }
  if (event.key === "Escape") {
    if (drag.isMoving) drag.cancel();
    else if (store.isSearching.value) store.stop();
    else if (ruling.value !== null) ruling.value = null;
    else if (store.compared.value.length > 0) store.compared.value = [];
    else if (store.tool.value === "draw") store.tool.value = "look";
    else {
      store.activeObject.value = null;
      store.select(null);
    }
    return;
  }
  if (isTyping || isCommand || event.altKey) return;
  if (event.key === "Enter" && target.tagName !== "BUTTON") store.run();
  else if (event.key === "f") stage.fit();
  else if (event.key === "t") store.showGhost.value = !store.showGhost.value;
  else if (event.key === " " && target.tagName !== "BUTTON") play();
  else if (event.key === "c") store.compare();
  else if (event.key === "x") store.showDifference.value = !store.showDifference.value;
  else if (event.key === "d" && store.kind.value === "scene") store.tool.value = store.tool.value === "draw" ? "look" : "draw";
  else if (event.key === "r" && level) store.reroll(level, 1);
  else if (event.key === "h" && level) store.holdOrFree(level);
  else if (event.key === "s" && store.picked.value) {
    const key = store.picked.value;
    void store.tell({ kind: "star", key, on: !store.isStarred(key) });
  } else return;
  event.preventDefault();
}

render(<App />, document.body);
later(warm);

// Numbers for tests, which never compare pixels.
Object.assign(window, {
  __studio: {
    get view() {
      return store.view.value;
    },
    get shown() {
      return { ...shown, parts: stage.piece?.header.parts ?? [], triangles: stage.piece?.header.triangles ?? 0 };
    },
    get camera() {
      return [...stage.camera.matrixWorld.elements, stage.camera.fov];
    },
    get notices() {
      return store.notices.value;
    },
    get mask() {
      const now = store.mask.value;
      return now === null ? null : { ...now.header, share: now.marks.reduce((sum, mark) => sum + mark, 0) / now.marks.length };
    },
    /** The box of the scene on the canvas, CSS pixels: left, top, right, bottom. */
    get box() {
      return stage.box();
    },
    get selection() {
      return { level: store.level.value, part: store.part.value };
    },
    get described() {
      return store.described.value;
    },
    get frames() {
      return stage.frames;
    },
    get drag() {
      return { left: drag.left, reason: store.dragNote.value };
    },
    get objects() {
      return stage.objects.names;
    },
    get counts() {
      return store.difference.value === null ? null : store.counts.value;
    },
    frameSeconds: (count: number) => stage.frameSeconds(count),
    /** Whether nothing on the page is still being drawn or moving. */
    get isStill() {
      const isMoving = (animation: Animation) => animation.effect?.getComputedTiming().endTime !== Infinity;
      const cards = [...document.querySelectorAll<HTMLCanvasElement>(".gallery canvas")];
      return stage.isDrawn && !document.getAnimations().some(isMoving) && cards.every((card) => card.dataset.drawn) && document.fonts.status === "loaded";
    },
    get compared() {
      return stage.compared;
    },
    get comparedDetails() {
      return sideShapes.value.map(([shape]) => shape.detail);
    },
    get drawn() {
      const { start, count } = stage.piece!.geometry.drawRange;
      const owners = stage.piece!.owners.slice(start, Math.min(count, 3 * stage.piece!.owners.length) / 3);
      return [...new Set(owners)].map((part) => stage.piece!.header.parts[part]);
    },
    get bests() {
      return shown.bests;
    },
    get isGhostShown() {
      if (store.kind.value === "coloring") return plan.value !== null;
      return stage.objects.source("target") === (store.target.value?.source ?? null);
    },
    get ghost() {
      return stage.objects.triangles("target");
    },
    get handle() {
      return stage.handlePoint();
    },
    get bounds() {
      const { low, high } = stage.piece?.header ?? {};
      return { low, high };
    },
    get seesAll() {
      return stage.seesAll;
    },
    get palette() {
      return store.palette.value;
    },
    get judged() {
      return store.judged.value;
    },
    get arrows() {
      return stage.arrows.children.length;
    },
    get easel() {
      return easel.value === null ? null : { name: easel.value.name, detail: easel.value.detail };
    },
    /** A point of a region, in CSS pixels of the middle. */
    regionPoint: (name: string) => {
      const place = placeOf(name);
      return place === null ? null : [frame.at[0] + place[0] * frame.at[2], frame.at[1] + place[1] * frame.at[3]];
    },
    pointOf: (address: string) => stage.pointOf(address),
    hold: (name: string) => store.holdOrFree(name),
    tell: store.tell,
    forgetChoice: store.forgetChoice,
  },
});
