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

type Mode = "translate" | "scale" | "rotate" | null;

function App() {
  const [handles, setHandles] = useState<Mode>(null);
  const [isDropping, setDropping] = useState(false);
  useEffect(() => {
    const key = (event: KeyboardEvent) => pressed(event, setHandles);
    addEventListener("keydown", key);
    return () => removeEventListener("keydown", key);
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
      <Setup handles={handles} setHandles={setHandles} />
      <Canvas handles={handles} />
      <Inspector />
      <Gallery />
    </div>
  );
}

function pressed(event: KeyboardEvent, setHandles: (mode: Mode) => void): void {
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
      setHandles(null);
      store.select(null);
    }
    return;
  }
  if (isTyping || isCommand || event.altKey) return;
  if (event.key === "Enter" && target.tagName !== "BUTTON") store.run();
  else if (event.key === "f") stage.fit();
  else if (event.key === "t") store.showGhost.value = !store.showGhost.value;
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
    pointOf: (address: string) => stage.pointOf(address),
  },
});
