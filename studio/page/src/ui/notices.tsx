// Messages over the middle, each a sentence with its details folded; the error of a model; the lost connection.

import * as store from "../store";
import { Icon } from "./icons";

export function Problem() {
  const problem = store.view.value?.problem;
  if (problem == null) return null;
  const [sentence] = store.folded(problem.text);
  const place = problem.place === null ? "" : `${problem.place.path.replace(/^.*\//, "")}:${problem.place.line}`;
  return (
    <div class="problem" role="alert">
      <h3>
        {place !== "" && <span class="place">{place}</span>} {sentence}
      </h3>
      <p>The last valid shape stays. Correct the file and save it again.</p>
      <details>
        <summary>Details</summary>
        <pre>{problem.text}</pre>
      </details>
    </div>
  );
}

export function Notices() {
  return (
    <div class="notices" aria-live="polite">
      {store.notices.value.map((notice) => (
        <div key={notice.id} class={notice.isError ? "notice error" : "notice"}>
          <div>
            <p>{notice.text}</p>
            {notice.offer && (
              <button
                class="button small"
                onClick={() => {
                  store.dismiss(notice.id);
                  notice.offer!.act();
                }}
              >
                {notice.offer.label}
              </button>
            )}
            {notice.details !== "" && (
              <details>
                <summary>Details</summary>
                <pre>{notice.details}</pre>
              </details>
            )}
          </div>
          <button class="icon-button tiny" title="Dismiss" onClick={() => store.dismiss(notice.id)}>
            <Icon name="close" />
          </button>
        </div>
      ))}
    </div>
  );
}

/** Lies over the page while the studio does not answer. */
export function Lost() {
  if (!store.isLost.value) return null;
  return (
    <div class="lost" role="alert">
      <h3>Not connected</h3>
      <p>The studio has ended or does not answer. All steps are on the disk. Start it again with the same session; this page comes back by itself.</p>
    </div>
  );
}
