// Niwaki's studio: the page.

import { render } from "preact";
import { useEffect, useState } from "preact/hooks";
import "./style.css";
import * as store from "./store";
import { Bar } from "./ui/bar";
import { Canvas, drag, shown, stage } from "./ui/canvas";
import { Gallery } from "./ui/gallery";
import { Inspector } from "./ui/inspector";
import { Setup } from "./ui/setup";

function App() {
  const [isDropping, setDropping] = useState(false);
  useEffect(() => {
    addEventListener("keydown", pressed);
    return () => removeEventListener("keydown", pressed);
  }, []);
  return (
    <div
      class={isDropping ? "app dropping" : "app"}
      onDragOver={(event) => {
        event.preventDefault();
        setDropping(true);
      }}
      onDragLeave={() => setDropping(false)}
      onDrop={(event) => {
        event.preventDefault();
        setDropping(false);
        const file = event.dataTransfer?.files[0];
        if (file) void store.uploaded(file);
      }}
    >
      <Bar onFit={() => stage.fit()} />
      <Setup />
      <Canvas />
      <Inspector />
      <Gallery />
    </div>
  );
}

function pressed(event: KeyboardEvent): void {
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
    else if (store.tool.value === "draw") store.tool.value = "look";
    else {
      store.thing.value = null;
      store.select(null);
    }
    return;
  }
  if (isTyping || isCommand || event.altKey) return;
  if (event.key === "Enter" && target.tagName !== "BUTTON") store.run();
  else if (event.key === "f") stage.fit();
  else if (event.key === "t") store.showGhost.value = !store.showGhost.value;
  else if (event.key === "x") store.showDifference.value = !store.showDifference.value;
  else if (event.key === "d") store.tool.value = store.tool.value === "draw" ? "look" : "draw";
  else if (event.key === "r" && level) store.reroll(level, 1);
  else if (event.key === "p" && level) store.pinOrFree(level);
  else if (event.key === "s" && store.picked.value) {
    const key = store.picked.value;
    void store.tell({ kind: "star", key, on: !store.isStarred(key) });
  } else return;
  event.preventDefault();
}

render(<App />, document.body);

// What tests look at: numbers, never pixels.
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
      return { left: drag.left, reason: store.quiet.value };
    },
    get things() {
      return stage.things.names;
    },
    get counts() {
      return store.difference.value === null ? null : store.counts.value;
    },
    get differs() {
      return `${store.difference.value?.header.key?.number ?? ""}`;
    },
    get handle() {
      return stage.handlePoint();
    },
    get bounds() {
      const { low, high } = stage.piece?.header ?? {};
      return { low, high };
    },
    pointOf: (address: string) => stage.pointOf(address),
  },
});
