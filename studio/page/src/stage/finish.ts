// The material of shapes: colour, metalness and roughness of each vertex. Metal reflects a sky that is lighter above.

import { MeshStandardMaterial } from "three";

const SKY = `
  vec3 sky = mix(vec3(0.32, 0.31, 0.3), vec3(1.05, 1.06, 1.08),
    smoothstep(-0.7, 0.9, dot(reflect(-geometryViewDir, geometryNormal), (viewMatrix * vec4(0.0, 1.0, 0.0, 0.0)).xyz)));
  radiance += vFinish.x * sky;`;

export function solid(flatShading: boolean): MeshStandardMaterial {
  const material = new MeshStandardMaterial({ vertexColors: true, flatShading });
  material.onBeforeCompile = (shader) => {
    shader.vertexShader = shader.vertexShader
      .replace("#include <common>", "attribute vec2 finish;\nvarying vec2 vFinish;\n#include <common>")
      .replace("#include <begin_vertex>", "#include <begin_vertex>\nvFinish = finish;");
    shader.fragmentShader = shader.fragmentShader
      .replace("#include <common>", "varying vec2 vFinish;\n#include <common>")
      .replace("#include <roughnessmap_fragment>", "float roughnessFactor = vFinish.y;")
      .replace("#include <metalnessmap_fragment>", "float metalnessFactor = vFinish.x;")
      .replace("#include <lights_fragment_maps>", `#include <lights_fragment_maps>${SKY}`);
  };
  return material;
}
