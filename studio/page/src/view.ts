// The stage of the studio, a separate script with all of three.js. The studio's page imports it. Alone, it shows results in
// a notebook (an anywidget) or in a page of one file.

import type { Shape } from "./messages";
import { Stage } from "./stage/stage";

export { KINDS, pixels } from "./stage/cells";
export type { Order } from "./stage/growth";
export { isBelow } from "./stage/meshes";
export { kindOf, MODES, type Mode, numberOf } from "./stage/objects";
export { HEIGHT, later, thumbnail, warm, WIDTH } from "./stage/thumbs";
export { Vector3 } from "three";
export { Stage };

interface Model {
  get(name: "frames"): DataView[];
  on(event: "change:frames", call: () => void): void;
}

interface Picture {
  header: Shape;
  payload: ArrayBuffer;
}

const STYLE = `
.niwaki-view { font: 13px/1.4 system-ui, sans-serif; color: #4a4741; background: #f3f1ec; border-radius: 6px; overflow: hidden; }
.niwaki-view canvas { display: block; width: 100%; height: 420px; cursor: grab; touch-action: none; }
.niwaki-view .bar { display: flex; gap: 4px; padding: 6px 10px; align-items: center; flex-wrap: wrap; min-height: 26px; }
.niwaki-view button { font: inherit; border: 1px solid #cfcabf; border-radius: 4px; background: #fff; padding: 1px 8px; cursor: pointer; }
.niwaki-view button[aria-pressed="true"] { background: #d0652b; border-color: #d0652b; color: #fff; }
.niwaki-view output { margin-left: 8px; }
`;

/** Unpacks a frame: see python/niwaki/studio/frames.py. */
function unpackFrame(view: DataView): Picture {
  const bytes = view.buffer.slice(view.byteOffset, view.byteOffset + view.byteLength) as ArrayBuffer;
  const length = new DataView(bytes).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 4, length))) as Shape;
  return { header, payload: bytes.slice(4 + length) };
}

/** Shows pictures in an element; returns a function that removes them. */
function show(element: HTMLElement, frames: DataView[]): () => void {
  const pictures = frames.map(unpackFrame);
  const ghost = pictures.find(({ header }) => header.role === "ghost");
  const results = pictures.filter(({ header }) => header.role !== "ghost");
  element.innerHTML = `<style>${STYLE}</style><div class="niwaki-view"><canvas tabindex="0"></canvas><div class="bar"></div></div>`;
  const canvas = element.querySelector("canvas")!;
  const bar = element.querySelector<HTMLElement>(".bar")!;
  const text = document.createElement("output");
  const stage = new Stage(canvas, () => {}, () => {});

  const show = (number: number) => {
    const { header, payload } = results[number];
    stage.show(header, payload);
    text.value = header.note;
    bar.querySelectorAll("button[data-number]").forEach((button, k) => button.setAttribute("aria-pressed", `${k === number}`));
  };
  const button = (label: string, title: string, press: (element: HTMLButtonElement) => void) => {
    const element = document.createElement("button");
    element.textContent = label;
    element.title = title;
    element.onclick = () => press(element);
    bar.append(element);
    return element;
  };
  if (results.length > 1) {
    results.forEach(({ header }, k) => (button(`${k + 1}`, header.note, () => show(k)).dataset.number = `${k}`));
  }
  if (ghost !== undefined) {
    stage.setSolid("target", ghost.header, ghost.payload, { source: "" });
    const turn = button("Target", "Show or hide the target", (element) => {
      const isShown = element.getAttribute("aria-pressed") !== "true";
      element.setAttribute("aria-pressed", `${isShown}`);
      stage.setGhostVisible(isShown);
    });
    turn.setAttribute("aria-pressed", "true");
  }
  button("Fit", "Fit the scene into the view", () => stage.fit());
  bar.append(text);

  // A click names a part; a drag turns the scene.
  let from: [number, number] = [0, 0];
  canvas.addEventListener("pointerdown", ({ clientX, clientY }) => (from = [clientX, clientY]));
  canvas.addEventListener("click", ({ clientX, clientY, offsetX, offsetY }) => {
    if (Math.hypot(clientX - from[0], clientY - from[1]) > 4) return;
    const part = stage.partAt(offsetX, offsetY);
    stage.mark((address) => address === part, () => false, () => false);
    if (part !== null) text.value = part;
  });
  const size = new ResizeObserver(() => stage.resize(canvas.clientWidth, canvas.clientHeight));
  size.observe(canvas);
  stage.resize(canvas.clientWidth, canvas.clientHeight);
  if (results.length > 0) show(0);
  stage.fit();
  Object.assign(element, { stage });
  return () => {
    size.disconnect();
    element.replaceChildren();
  };
}

/** Decodes the frames of a page of one file: base64 of deflated bytes for each. */
function decoded(texts: string[]): Promise<DataView[]> {
  return Promise.all(
    texts.map(async (text) => {
      const packed = new Blob([Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0))]);
      const stream = packed.stream().pipeThrough(new DecompressionStream("deflate"));
      return new DataView(await new Response(stream).arrayBuffer());
    }),
  );
}

export default {
  render({ model, el }: { model: Model; el: HTMLElement }): () => void {
    let remove = show(el, model.get("frames"));
    model.on("change:frames", () => {
      remove();
      remove = show(el, model.get("frames"));
    });
    return () => remove();
  },
};

const page = document.getElementById("niwaki-frames");
if (page !== null) {
  const frames = await decoded(JSON.parse(page.textContent!) as string[]);
  show(document.querySelector("div")!, frames);
}
