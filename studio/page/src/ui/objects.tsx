// A row for each object of the scene beside its target: floor, obstacles, light and camera of a sketch.

import { useRef } from "preact/hooks";
import * as store from "../store";
import { kindOf, MODES, type Mode, numberOf } from "../view";
import { stage } from "./canvas";
import { Field } from "./fields";
import { Icon } from "./icons";
import { Menu } from "./menu";

export const title = (name: string): string => {
  const bare = name.replace(/^.*\//, "").replace(/^(gallery|stack|drawing):/, "").replace(/_/g, " ");
  return bare.startsWith("upload:") ? (name.startsWith("drawing:") ? "your drawing" : "your mesh") : bare;
};

const NAMES: Record<Mode, [string, string]> = {
  translate: ["move", "Move"],
  scale: ["scale", "Scale"],
  rotate: ["turn", "Turn"],
};

/** The buttons for the handles of an object. */
export function Handles({ name }: { name: string }) {
  const now = store.activeObject.value;
  return (
    <>
      {MODES[kindOf(name)].map((mode) => {
        const isOn = now?.name === name && now.mode === mode;
        return (
          <button
            key={mode}
            class="icon-button small"
            title={`${NAMES[mode][1]} the ${label(name)}`}
            aria-pressed={isOn}
            onClick={() => (store.activeObject.value = isOn ? null : { name, mode })}
          >
            <Icon name={NAMES[mode][0]} />
          </button>
        );
      })}
    </>
  );
}

const label = (name: string): string => {
  const { obstacles = [] } = store.view.value?.ask ?? {};
  if (kindOf(name) !== "obstacle") return name;
  const source = obstacles[numberOf(name)]?.source ?? "";
  return obstacles.length > 1 ? `${title(source)} ${numberOf(name) + 1}` : title(source);
};

export function Objects() {
  const { ask, model } = store.view.value!;
  const input = useRef<HTMLInputElement>(null);
  if (model?.draws) return null;
  const obstacles = ask.obstacles ?? [];
  const remove = (number: number) => {
    store.activeObject.value = null;
    store.ask({ obstacles: obstacles.filter((_, k) => k !== number) });
  };
  const add = (source: string) => {
    if (source === "mesh") input.current?.click();
    else if (source === "floor") store.whenTargetIsShown(() => store.ask({ floor: stage.bottom() }));
    else store.whenTargetIsShown(() => store.avoid(stage.above(source)));
  };
  return (
    <section aria-label="Objects of the scene">
      <div class="head">
        <h2>In the scene</h2>
        <Menu
          look="icon-button small"
          title="Add an object"
          isNarrow
          face={<Icon name="plus" />}
          items={[
            ...(ask.floor == null ? [{ name: "Floor", use: "all parts stay above it", act: () => add("floor") }] : []),
            ...["box", "ball", "column"].map((source) => ({
              name: source[0].toUpperCase() + source.slice(1),
              use: "an obstacle",
              act: () => add(source),
            })),
            { name: "Mesh…", use: "an obstacle", act: () => add("mesh") },
          ]}
        />
      </div>
      {ask.floor == null && obstacles.length === 0 && ask.sketch == null && (
        <p class="quiet">The scene has only its target. Add a floor or an obstacle.</p>
      )}
      {ask.floor != null && (
        <Row name="floor" icon="floor" onRemove={() => store.ask({ floor: null })}>
          <Field
            type="number"
            step="any"
            aria-label="Height of the floor"
            value={ask.floor}
            onEnd={(text) => text !== "" && store.ask({ floor: Number(text) })}
          />
        </Row>
      )}
      {obstacles.map((obstacle, k) => (
        <Row key={k} name={`obstacle ${k}`} icon={obstacle.source === "ball" ? "ball" : "box"} onRemove={() => remove(k)} />
      ))}
      {ask.sketch?.kind === "shadow" && <Row name="light" icon="sun" />}
      {ask.sketch?.camera != null && (
        <Row name="camera" icon="camera">
          <button class="text-button" title="Look through the camera of the sketch" onClick={() => stage.lookFrom(ask.sketch!.camera!)}>
            look
          </button>
        </Row>
      )}
      <input
        ref={input}
        type="file"
        hidden
        accept=".obj,.stl,.ply,.glb,.gltf"
        aria-label="A mesh as an obstacle"
        onChange={(event) => {
          const file = event.currentTarget.files?.[0];
          if (file) void store.upload(file, true);
          event.currentTarget.value = "";
        }}
      />
    </section>
  );
}

function Row({ name, icon, onRemove, children }: { name: string; icon: string; onRemove?: () => void; children?: any }) {
  const text = label(name);
  return (
    <div class={store.activeObject.value?.name === name ? "object selected" : "object"}>
      <Icon name={icon} />
      <span>{text}</span>
      {children}
      <Handles name={name} />
      {onRemove && (
        <button class="icon-button small" title={`Remove the ${text}`} onClick={onRemove}>
          <Icon name="close" />
        </button>
      )}
    </div>
  );
}
