// Colours of curves, and with each a pattern of dashes: a curve is never told by its colour alone.
const light = ['#0b62c4', '#b3400b', '#14783c', '#8a2da8', '#a8620a', '#0d7377', '#b0245c', '#4a5568'];
const dark = ['#6db3ff', '#ff9d6b', '#63d18c', '#d69bf0', '#f2c14e', '#5fd3d6', '#ff8fb8', '#b8c2d0'];
export const dashes: number[][] = [[], [8, 3], [2, 3], [10, 3, 2, 3], [5, 5], [14, 4], [3, 2, 3, 6], [1, 2]];

export const isDark = (): boolean => matchMedia('(prefers-color-scheme: dark)').matches;
export const colour = (i: number): string => (isDark() ? dark : light)[i % light.length]!;
export const ofStyle = (name: string): string => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
export function onScheme(redraw: () => void): void {
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', redraw);
}
