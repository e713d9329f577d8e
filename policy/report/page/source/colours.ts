// Colours that people of every colour vision tell apart. Their values stand in style.css, for light and dark.

/** A colour of the page by its name in style.css: "heard" is --heard. */
export function colour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

export function isDark(): boolean {
  return colour("scheme") === "dark";
}

/** Called when the reader's screen turns light or dark, and when a page on paper is wanted, which is light. */
export function onScheme(listener: () => void): void {
  for (const query of ["(prefers-color-scheme: dark)", "print"]) matchMedia(query).addEventListener("change", listener);
}

// Source: Nunez, Anderton, Renslow, "Optimizing colormaps with consideration for color vision deficiency", PLoS ONE 13 (2018): cividis.
const CIVIDIS = [[0, 32, 77], [49, 68, 107], [102, 105, 112], [149, 143, 120], [203, 186, 105], [255, 234, 70]];

/** Red, green, blue of a share from 0 (dark blue) to 1 (yellow). */
export function cividis(share: number): [number, number, number] {
  const at = Math.min(Math.max(share, 0), 1) * (CIVIDIS.length - 1);
  const below = Math.min(Math.floor(at), CIVIDIS.length - 2);
  const mix = (channel: number) => {
    const from = CIVIDIS[below]![channel]!;
    return Math.round(from + (at - below) * (CIVIDIS[below + 1]![channel]! - from));
  };
  return [mix(0), mix(1), mix(2)];
}
