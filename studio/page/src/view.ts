// The studio's stage: a script of its own, with all of three.js. The studio's page imports it; by itself it shows results in
// a notebook (an anywidget) or in a page that is one file.

import type { Shape } from "./messages";
import { Stage } from "./stage/stage";

export { KINDS, pixels } from "./stage/cells";
export type { Order } from "./stage/growth";
export { isBelow } from "./stage/meshes";
export { kindOf, MODES, type Mode, numberOf } from "./stage/things";
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

/** A frame: see python/niwaki/studio/frames.py. */
function opened(view: DataView): Picture {
  const bytes = view.buffer.slice(view.byteOffset, view.byteOffset + view.byteLength) as ArrayBuffer;
  const length = new DataView(bytes).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 4, length))) as Shape;
  return { header, payload: bytes.slice(4 + length) };
}

/** Show pictures in an element; the function that it returns takes them away. */
function show(element: HTMLElement, frames: DataView[]): () => void {
  const pictures = frames.map(opened);
  const ghost = pictures.find(({ header }) => header.what === "ghost");
  const results = pictures.filter(({ header }) => header.what !== "ghost");
  element.innerHTML = `<style>${STYLE}</style><div class="niwaki-view"><canvas tabindex="0"></canvas><div class="bar"></div></div>`;
  const canvas = element.querySelector("canvas")!;
  const bar = element.querySelector<HTMLElement>(".bar")!;
  const text = document.createElement("output");
  const stage = new Stage(canvas, () => {}, () => {});

  const show = (number: number) => {
    const { header, payload } = results[number];
    stage.show(header, payload);
    text.value = header.note;
    bar.querySelectorAll("button[data-number]").forEach((one, k) => one.setAttribute("aria-pressed", `${k === number}`));
  };
  const button = (label: string, title: string, press: (one: HTMLButtonElement) => void) => {
    const one = document.createElement("button");
    one.textContent = label;
    one.title = title;
    one.onclick = () => press(one);
    bar.append(one);
    return one;
  };
  if (results.length > 1) {
    results.forEach(({ header }, k) => (button(`${k + 1}`, header.note, () => show(k)).dataset.number = `${k}`));
  }
  if (ghost !== undefined) {
    stage.setSolid("target", ghost.header, ghost.payload, { source: "" });
    const turn = button("Target", "Show the target, or hide it", (one) => {
      const isShown = one.getAttribute("aria-pressed") !== "true";
      one.setAttribute("aria-pressed", `${isShown}`);
      stage.setGhostVisible(isShown);
    });
    turn.setAttribute("aria-pressed", "true");
  }
  button("Fit", "Look at everything", () => stage.fit());
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

/** The frames of a page that is one file: text of base64 for each, deflated. */
function decoded(texts: string[]): Promise<DataView[]> {
  return Promise.all(
    texts.map(async (text) => {
      const packed = new Blob([Uint8Array.from(atob(text), (one) => one.charCodeAt(0))]);
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
