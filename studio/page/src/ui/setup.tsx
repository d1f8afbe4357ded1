// The left side: the model and its arguments, the target, the settings of the search.

import type { ModelInfo, Parameter, Settings, View } from "../messages";
import * as store from "../store";
import { Drop } from "./drop";
import { Field } from "./fields";
import { Icon } from "./icons";
import { Handles, Objects, title } from "./objects";
import { stage } from "./canvas";

const GROUPS: [string, (model: ModelInfo) => boolean][] = [
  ["Your models", ({ is_file }) => is_file],
  ["Scenes", ({ is_file, kind }) => !is_file && kind === "scene"],
  ["Structures", ({ is_file, kind }) => !is_file && kind === "structure"],
  ["Drawings to colour", ({ kind }) => kind === "coloring"],
];

export function Setup() {
  const view = store.view.value;
  if (view === null) return <aside class="side" aria-label="Model and target" />;
  const { model } = view;
  // The list has no uploaded drawings.
  const isListed = model === null || view.models.some(({ reference }) => reference === model.reference);
  const models = isListed ? view.models : [...view.models, model];
  return (
    <aside class="side" aria-label="Model and target">
      <div class="scroll">
        <section>
          <h2>{store.kind.value === "coloring" ? "Drawing" : "Model"}</h2>
          <select
            aria-label="Model"
            value={view.model?.reference ?? ""}
            onChange={(event) => void store.tell({ kind: "model", reference: event.currentTarget.value })}
          >
            {GROUPS.map(([name, isIn]) => {
              const members = models.filter(isIn);
              return members.length === 0 ? null : (
                <optgroup key={name} label={name}>
                  {members.map(({ reference }) => (
                    <option key={reference} value={reference}>
                      {title(reference)}
                    </option>
                  ))}
                </optgroup>
              );
            })}
          </select>
          <p class="quiet">{view.model?.title}</p>
          {(view.model?.parameters ?? [])
            .filter((parameter) => parameter.default !== null)
            .map((parameter) => (
              <Argument key={parameter.name} parameter={parameter} />
            ))}
          {view.model?.is_file && isAnyChanged(view) && (
            <div class="actions">
              <button class="button small" onClick={() => void store.propose()} title="Show the change of the model's file without writing it">
                Make these the defaults
              </button>
            </div>
          )}
          {store.kind.value === "coloring" && <Drop kind="drawing" />}
        </section>
        {store.kind.value === "scene" && <Target />}
        {store.kind.value === "scene" && <Objects />}
        <Search settings={view.settings} />
      </div>
      <Start />
    </aside>
  );
}

/** Whether an argument differs from its default. */
const isAnyChanged = ({ model, arguments: values }: View): boolean =>
  (model?.parameters ?? []).some((parameter) => parameter.default !== null && (values[parameter.name] ?? parameter.default) !== parameter.default);

function Argument({ parameter }: { parameter: Parameter }) {
  const value = store.view.value!.arguments[parameter.name] ?? parameter.default;
  const set = (argument: unknown) => void store.tell({ kind: "set", arguments: { [parameter.name]: argument } });
  if (typeof parameter.default === "boolean") {
    return (
      <label class="row">
        <span>{parameter.name}</span>
        <input type="checkbox" checked={value} onChange={(event) => set(event.currentTarget.checked)} />
      </label>
    );
  }
  if (typeof parameter.default === "string") {
    return (
      <label class="row">
        <span>{parameter.name}</span>
        <Field type="text" value={value} onEnd={set} />
      </label>
    );
  }
  return (
    <label class="row">
      <span>{parameter.name}</span>
      <Field type="number" step={parameter.is_whole ? 1 : "any"} value={value} onEnd={(text) => text !== "" && set(Number(text))} />
    </label>
  );
}

function Target() {
  const view = store.view.value!;
  const target = store.target.value;
  const place = (source: string) => store.ask({ target: { source } });
  const isSketched = view.ask.sketch != null;
  const uploads = target?.source.startsWith("upload:") ? [target.source] : [];
  return (
    <section>
      <h2>Grow into</h2>
      {isSketched ? (
        <div class="group">
          <span>{view.ask.sketch?.kind === "shadow" ? "The shadow you drew" : "The silhouette you drew"}</span>
          <button class="text-button" onClick={() => store.ask({ sketch: null })}>
            clear
          </button>
        </div>
      ) : view.model?.draws && target === null ? (
        <p class="quiet">The model has its own drawing. Draw with the pen to replace it.</p>
      ) : (
        <select aria-label="Target" value={target?.source ?? ""} onChange={(event) => place(event.currentTarget.value)}>
          {target === null && <option value="">choose a target</option>}
          {uploads.map((source) => (
            <option key={source} value={source}>
              your mesh
            </option>
          ))}
          <optgroup label="Simple">
            {["box", "ball", "column"].map((source) => (
              <option key={source} value={source}>
                {source}
              </option>
            ))}
          </optgroup>
          <optgroup label="Gallery">
            {view.targets.map((source) => (
              <option key={source} value={source}>
                {title(source)}
              </option>
            ))}
          </optgroup>
        </select>
      )}
      {target !== null && (
        <div class="group" role="group" aria-label="Place the target">
          <Handles name="target" />
          {target.source.startsWith("upload:") && (
            <button
              class="icon-button small"
              title={target.up === "z" ? "Lay the mesh down again: its y axis points up" : "Stand the mesh up: its z axis points up"}
              aria-pressed={target.up === "z"}
              onClick={() => store.ask({ target: { ...target, up: target.up === "z" ? "y" : "z" } })}
            >
              <Icon name="upright" />
            </button>
          )}
          {view.ask.target != null && (
            <button class="text-button" onClick={() => store.ask({ target: null })}>
              reset
            </button>
          )}
        </div>
      )}
      <Sizes />
      <Drop kind="mesh" />
    </section>
  );
}

const size = (sides: [number, number, number]): string => sides.map((side) => Number(side.toPrecision(2)).toLocaleString("en")).join(" × ");

/** The sizes of model and target, and placements that make the target fit. */
function Sizes() {
  const { model, target, offers } = store.view.value!.sizes;
  if (model === null || target === null) return null;
  return (
    <div class="sizes" role="group" aria-label="Sizes">
      <dl title="Width, height and depth in scene units; the model's are those of a run">
        <dt>target</dt>
        <dd>{size(target)}</dd>
        <dt>model</dt>
        <dd>{size(model)}</dd>
      </dl>
      {offers.map(({ text, label, target }) => (
        <p key={label} class="unfit" role="status">
          {text}
          <button
            class="button small"
            onClick={() => {
              stage.followNext();
              store.ask({ target });
            }}
          >
            {label}
          </button>
        </p>
      ))}
    </div>
  );
}

const STRENGTHS = ["best", "little", "some", "more", "most"];

function Search({ settings }: { settings: Settings }) {
  const view = store.view.value!;
  const { set } = store;
  const isScene = store.kind.value === "scene";
  return (
    <section>
      <h2>Search</h2>
      <label class="row">
        <span>results</span>
        <Field
          type="range"
          min={1}
          max={16}
          value={settings.count}
          aria-valuetext={`${settings.count} results`}
          onEnd={(text) => set({ count: Number(text) })}
        />
        <output>{settings.count}</output>
      </label>
      {isScene && (
        <label class="row" title="Choose among the results of the search: the best, or the most different">
          <span>variety</span>
          <Field
            type="range"
            min={0}
            max={1}
            step={0.25}
            value={settings.strength}
            aria-label="Variety"
            aria-valuetext={STRENGTHS[Math.round(4 * (settings.strength ?? 0))]}
            onEnd={(text) => set({ strength: Number(text) })}
          />
          <output>{STRENGTHS[Math.round(4 * (settings.strength ?? 0))]}</output>
        </label>
      )}
      {isScene && (settings.count ?? 1) > 1 && (
        <label class="row" title="What tells results apart: the choices and calls that carry much of the scene, or the cells that they fill">
          <span>differ by</span>
          <select value={settings.by} onChange={(event) => set({ by: event.currentTarget.value as "kind" | "look" })}>
            <option value="kind">kind</option>
            <option value="look">look</option>
          </select>
        </label>
      )}
      <label class="row">
        <span>effort</span>
        <Field
          type="range"
          min={-2}
          max={3}
          step={1}
          value={Math.log2(settings.effort ?? 1)}
          aria-valuetext={`${settings.effort} times`}
          onEnd={(text) => set({ effort: 2 ** Number(text) })}
        />
        <output>{settings.effort}×</output>
      </label>
      <label class="row">
        <span>seed</span>
        <Field
          type="number"
          min={0}
          placeholder="random"
          value={settings.seed ?? ""}
          onEnd={(text) => set({ seed: text === "" ? null : Number(text) })}
        />
      </label>
      {view.losses !== "" && <p class="quiet losses">{view.losses.replaceAll("`", "")}</p>}
      {store.heldParts.value.size > 0 && (
        <ul class="held" aria-label="Held parts">
          {[...store.heldParts.value].map((part) => (
            <li key={part}>
              <Icon name="pin" filled />
              <button class="address" title={part} onClick={() => (store.level.value = part)}>
                {store.labelOf(part)}
              </button>
              <button class="icon-button tiny" title={`Free ${store.labelOf(part)}`} onClick={() => store.holdOrFree(part)}>
                <Icon name="close" />
              </button>
            </li>
          ))}
        </ul>
      )}
    </section>
  );
}

/** The button that starts and stops a search, always in view, with what is still missing. */
function Start() {
  const view = store.view.value!;
  const running = view.searching;
  const verb = store.kind.value === "coloring" ? "Colour" : "Grow";
  const missing = store.missing.value;
  return (
    <div class="start">
      {missing !== "" && running === null && (
        <p id="missing" role="status">
          {missing}
        </p>
      )}
      {running === null ? (
        <button
          class="primary"
          disabled={missing !== ""}
          aria-describedby={missing === "" ? undefined : "missing"}
          onClick={store.run}
          title={`${verb} (Enter)`}
        >
          {store.heldParts.value.size > 0 ? `${verb} the rest` : verb}
        </button>
      ) : (
        <button class="primary stop" onClick={store.stop} title="Stop and keep the results so far (Esc)">
          Stop
          <small>
            {running.seconds.toFixed(1)} s{running.fit !== "" && ` · ${running.fit}`}
          </small>
        </button>
      )}
    </div>
  );
}
