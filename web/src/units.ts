// Numbers for people: four digits, angles in degrees, as the report in the terminal has them.
const degrees = 180 / Math.PI;

export function inUnit(value: number, unit: string): [number, string] {
  return unit.startsWith('rad') ? [value * degrees, unit.replace('rad', 'deg')] : [value, unit];
}

export function withUnit(value: number | null | undefined, unit: string): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return '–';
  const [shown, name] = inUnit(value, unit);
  const size = Math.abs(shown);
  let decimals = 3;
  for (let bound = 10; size >= bound && decimals > 0; bound *= 10) --decimals;
  const text = shown.toFixed(decimals).replace(/^-(?=[0.]*$)/, '');
  return name ? `${text} ${name}` : text;
}

export const seconds = (time: number): string => `${time.toFixed(3)} s`;
