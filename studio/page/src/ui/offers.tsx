// Offered changes of the model's file, shown as differences: numbers that explain the last drag, or arguments as defaults.

import type { Offer } from "../messages";
import * as store from "../store";
import { Icon } from "./icons";

export function Offers() {
  return (
    <div class="offers" role="region" aria-label="Changes of the source">
      {store.offers.value.map((offer) => (
        <details key={offer.difference} class="notice offer">
          <summary>{offer.label}</summary>
          <pre>
            {offer.difference
              .split("\n")
              .slice(2)
              .map((line) => (
                <span class={line.startsWith("+") ? "added" : line.startsWith("-") ? "removed" : ""}>{line + "\n"}</span>
              ))}
          </pre>
          <button class="button" onClick={() => void accept(offer)} title="Write this change into the model's file">
            Write
          </button>
        </details>
      ))}
      {store.offers.value.length > 0 && (
        <button class="icon-button tiny" title="Dismiss: leave the file unchanged" onClick={() => (store.offers.value = [])}>
          <Icon name="close" />
        </button>
      )}
    </div>
  );
}

async function accept(offer: Offer): Promise<void> {
  store.offers.value = [];
  // The change of the file replaces the changed choices of the drag, so these are undone; other offers keep them.
  if (offer.is_instead && store.hasDragged.value) await store.tell({ kind: "undo" });
  await store.tell({ kind: "rewrite", difference: offer.difference });
}
