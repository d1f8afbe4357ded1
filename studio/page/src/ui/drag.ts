// A pointer that drags the selected part: in the plane through the held point that faces the camera. While the part cannot
// follow, a line goes from it to the pointer, and a quiet line of text says why. Esc ends the drag with nothing changed.

import type { Shape } from "../messages";
import * as store from "../store";
import { type Stage, Vector3 } from "../view";

/** Pixels that a pointer moves before a press becomes a drag. */
const SLACK = 4;

export class Drag {
  private held: { part: string; grab: Vector3; from: [number, number]; isMoving: boolean } | null = null;
  private goal = new Vector3();
  /** What was left to the pointer, as a share of the scene's size. */
  left = 0;

  constructor(private readonly stage: Stage) {}

  /** Whether a part is being moved. */
  get isMoving(): boolean {
    return this.held?.isMoving ?? false;
  }

  /** The pointer goes down; whether it holds the selected part, and not the camera. */
  press(x: number, y: number): boolean {
    const hit = store.tool.value === "look" && !store.isSearching.value ? this.stage.hitAt(x, y) : null;
    if (hit === null || hit.address !== store.part.value) return false;
    store.offers.value = [];
    this.held = { part: hit.address, grab: hit.point, from: [x, y], isMoving: false };
    this.stage.setOrbiting(false);
    return true;
  }

  /** The pointer moves; whether a part moves with it. */
  move(x: number, y: number): boolean {
    const held = this.held;
    if (held === null) return false;
    held.isMoving ||= Math.hypot(x - held.from[0], y - held.from[1]) >= SLACK;
    if (held.isMoving) {
      this.goal = this.stage.across(x, y, held.grab);
      void this.tell("move");
    }
    return held.isMoving;
  }

  /** The pointer goes up; whether a part was moved. */
  release(isFollowed: boolean): boolean {
    const wasMoving = this.isMoving;
    if (wasMoving) void this.end(isFollowed);
    this.forget();
    return wasMoving;
  }

  /** Esc: the part goes back. */
  cancel(): void {
    if (!this.isMoving) return;
    void this.tell("cancel").then(back);
    this.forget();
  }

  /** A shape of the part that moves has come. */
  shown(shape: Shape): void {
    if (!this.isMoving || shape.held === null) return;
    store.quiet.value = shape.note;
    this.left = shape.left;
    this.stage.tether(shape.note === "" ? null : new Vector3(...shape.held), this.goal);
  }

  private async end(isFollowed: boolean): Promise<void> {
    const answer = await this.tell("end", isFollowed);
    const found = answer?.kind === "dragged" ? answer : null;
    store.offers.value = found?.offers ?? [];
    store.hasDragged.value = (found?.changes.length ?? 0) > 0;
    if (found === null || found.reason !== "") {
      if (found !== null) store.note(found.reason);
      if (found === null || found.changes.length === 0) back();
    }
  }

  private tell(phase: "move" | "end" | "cancel", follow = false): ReturnType<typeof store.tell> {
    const { part, grab } = this.held!;
    const along = this.stage.sight(this.goal).toArray();
    return store.tell({ kind: "drag", part, to: this.goal.toArray(), grab: grab.toArray(), along, phase, follow });
  }

  private forget(): void {
    this.held = null;
    store.quiet.value = "";
    this.stage.tether(null, null);
    this.stage.setOrbiting(store.tool.value === "look");
  }
}

/** The picked result is shown as it was. */
function back(): void {
  const key = store.picked.value;
  if (key !== null) void store.tell({ kind: "show", key, detail: "fine" });
}
