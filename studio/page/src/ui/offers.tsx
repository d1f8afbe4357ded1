// Changes of the model's file that explain the last drag, or arguments as defaults: shown as differences, written when accepted.

import type { Offer } from "../messages";
import * as store from "../store";
import { Icon } from "./icons";

export function Offers() {
  return (
    <div class="offers" role="region" aria-label="Changes of the source">
      {store.offers.value.map((one) => (
        <details key={one.difference} class="notice offer">
          <summary>{one.says}</summary>
          <pre>
            {one.difference
              .split("\n")
              .slice(2)
              .map((line) => (
                <span class={line.startsWith("+") ? "added" : line.startsWith("-") ? "removed" : ""}>{line + "\n"}</span>
              ))}
          </pre>
          <button class="button" onClick={() => void accept(one)} title="Write this into the model's file">
            Write it
          </button>
        </details>
      ))}
      {store.offers.value.length > 0 && (
        <button class="icon-button tiny" title="Leave the file as it is" onClick={() => (store.offers.value = [])}>
          <Icon name="close" />
        </button>
      )}
    </div>
  );
}

async function accept(offer: Offer): Promise<void> {
  store.offers.value = [];
  // The file takes the place of the choices that the drag has changed, unless they change with it.
  if (offer.is_instead && store.hasDragged.value) await store.tell({ kind: "undo" });
  await store.tell({ kind: "rewrite", difference: offer.difference });
}
