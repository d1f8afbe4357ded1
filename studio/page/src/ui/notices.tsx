// Messages over the middle: what was refused, and the error of a model that does not compile.

import * as store from "../store";
import { Icon } from "./icons";

export function Problem() {
  const problem = store.view.value?.problem;
  if (problem == null) return null;
  return (
    <div class="problem" role="alert">
      <h3>{problem.place === null ? problem.code : `${problem.place.path.replace(/^.*\//, "")}:${problem.place.line}`}</h3>
      <pre>{problem.text}</pre>
      <p>The last good shape stays. Save the file again to go on.</p>
    </div>
  );
}

export function Notices() {
  return (
    <div class="notices" aria-live="polite">
      {store.notices.value.map((one) => (
        <div key={one.id} class={one.isError ? "notice error" : "notice"}>
          <pre>{one.text}</pre>
          <button class="icon-button tiny" title="Dismiss" onClick={() => store.dismiss(one.id)}>
            <Icon name="close" />
          </button>
        </div>
      ))}
    </div>
  );
}
