// Whether the words of a page can be read.

/** Texts with less than 4.5:1 to what lies behind them (WCAG 2, AA). */
export const tooFaint = (page) => page.evaluate(() => {
  const context = document.createElement('canvas').getContext('2d', { willReadFrequently: true });
  const rgba = (colour) => {
    context.clearRect(0, 0, 1, 1);
    context.fillStyle = colour;
    context.fillRect(0, 0, 1, 1);
    return [...context.getImageData(0, 0, 1, 1).data];
  };
  const light = ([r, g, b]) => [r, g, b].map((c) => c / 255).map((c) => (c <= 0.03928 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4))
    .reduce((sum, c, i) => sum + c * [0.2126, 0.7152, 0.0722][i], 0);
  const behind = (element) => {
    const layers = [];
    for (let at = element; at; at = at.parentElement) layers.push(rgba(getComputedStyle(at).backgroundColor));
    return layers.reverse().reduce((below, [r, g, b, a]) => [r, g, b].map((c, i) => c * (a / 255) + below[i] * (1 - a / 255)), [255, 255, 255]);
  };
  const faint = [];
  for (const element of document.querySelectorAll('h1, h2, h3, p, td, th, dt, dd, button, figcaption, span, output, li, label, legend, code')) {
    const hasText = [...element.childNodes].some((node) => node.nodeType === 3 && node.textContent.trim());
    const style = getComputedStyle(element);
    if (!hasText || element.getClientRects().length === 0 || rgba(style.color)[3] < 10) continue;
    const [a, b] = [light(rgba(style.color)), light(behind(element))].sort((p, q) => q - p);
    if ((a + 0.05) / (b + 0.05) < 4.5) faint.push(`${element.tagName} ${element.className}: ${element.textContent.slice(0, 30)}`);
  }
  return [...new Set(faint)].slice(0, 10);
});
