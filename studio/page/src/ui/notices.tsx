// Messages over the middle: failed commands, and the error of a model that does not compile.

import * as store from "../store";
import { Icon } from "./icons";

export function Problem() {
  const problem = store.view.value?.problem;
  if (problem == null) return null;
  return (
    <div class="problem" role="alert">
      <h3>{problem.place === null ? problem.code : `${problem.place.path.replace(/^.*\//, "")}:${problem.place.line}`}</h3>
      <pre>{problem.text}</pre>
      <p>The last valid shape stays. Correct the file and save it again.</p>
    </div>
  );
}

export function Notices() {
  return (
    <div class="notices" aria-live="polite">
      {store.notices.value.map((notice) => (
        <div key={notice.id} class={notice.isError ? "notice error" : "notice"}>
          <pre>{notice.text}</pre>
          <button class="icon-button tiny" title="Dismiss" onClick={() => store.dismiss(notice.id)}>
            <Icon name="close" />
          </button>
        </div>
      ))}
    </div>
  );
}
