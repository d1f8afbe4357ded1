// A place to drop or choose files: a mesh to grow into, a drawing to colour.

import { useRef } from "preact/hooks";
import * as store from "../store";

const UPLOADS = {
  mesh: { text: "Drop a mesh here", formats: "OBJ, STL, PLY, GLB", accept: ".obj,.stl,.ply,.glb,.gltf" },
  drawing: { text: "Drop a drawing here", formats: "SVG, or an image in flat colours", accept: ".svg,.png,.webp,.bmp,.gif,.tif,.tiff,.jpg,.jpeg" },
};

export function Drop({ kind }: { kind: keyof typeof UPLOADS }) {
  const input = useRef<HTMLInputElement>(null);
  const { text, formats, accept } = UPLOADS[kind];
  return (
    <>
      <button class="drop" onClick={() => input.current?.click()}>
        {text} <span>{formats}</span>
      </button>
      <input
        ref={input}
        type="file"
        hidden
        accept={accept}
        aria-label={kind === "mesh" ? "A mesh to grow into" : "A drawing to colour"}
        onChange={(event) => {
          const file = event.currentTarget.files?.[0];
          if (file) void store.upload(file);
          event.currentTarget.value = "";
        }}
      />
    </>
  );
}
