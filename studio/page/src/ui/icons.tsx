// Line icons, 16 by 16, drawn for this page.

const PATHS: Record<string, string> = {
  undo: "M6 3.5 2.5 7 6 10.5 M3 7h6a4 4 0 0 1 0 8H7",
  redo: "M10 3.5 13.5 7 10 10.5 M13 7H7a4 4 0 0 0 0 8h2",
  pin: "M5.5 2h5 M6.5 2v4.5L4.5 9.5h7L9.500 6.5V2 M8 9.500V14",
  dice: "M3 3h10v10H3z M6 6h.01 M10 6h.01 M6 10h.01 M10 10h.01 M8 8h.01",
  star: "M8 2l1.8 3.8 4.200.5-3.100 2.900.8 4.100L8 11.300 4.300 13.300l.8-4.100L2 6.300l4.200-.5z",
  fit: "M2.500 6V2.500H6 M10 2.500h3.500V6 M13.500 10v3.500H10 M6 13.500H2.500V10",
  pen: "M3 13l.8-3L11 2.800 13.200 5 6 12.200z M9.500 4.300l2.200 2.200",
  ghost: "M2 8s2.200-4 6-4 6 4 6 4-2.200 4-6 4-6-4-6-4z M8 6.300a1.700 1.700 0 1 0 0 3.400 1.700 1.700 0 0 0 0-3.400z",
  sun: "M8 5a3 3 0 1 0 0 6 3 3 0 0 0 0-6z M8 1.500v1 M8 13.500v1 M1.500 8h1 M13.500 8h1 M3.400 3.400l.7.7 M11.900 11.900l.7.7 M3.400 12.600l.7-.7 M11.900 4.100l.7-.7",
  moon: "M13 9.500A5.500 5.500 0 1 1 6.500 3 4.500 4.500 0 0 0 13 9.500z",
  close: "M4 4l8 8 M12 4l-8 8",
  move: "M8 2v12 M2 8h12 M8 2 6.500 3.500 M8 2l1.500 1.500 M8 14l-1.500-1.500 M8 14l1.500-1.500 M2 8l1.500-1.500 M2 8l1.500 1.500 M14 8l-1.500-1.500 M14 8l-1.500 1.500",
  save: "M8 2v8 M5 7.500 8 10.500 11 7.500 M3 13.500h10",
  compare: "M8 2v12 M2.500 4H6v8H2.500z M10 4h3.500v8H10z",
};

export function Icon({ name, filled = false }: { name: string; filled?: boolean }) {
  return (
    <svg class="icon" viewBox="0 0 16 16" aria-hidden="true">
      <path d={PATHS[name]} class={filled ? "filled" : ""} />
    </svg>
  );
}
