"""The contrast of all text that is shown on a page to what lies behind it."""

WCAG_AA = 4.5
"""Least contrast of text to its background (Web Content Accessibility Guidelines 2.2, 1.4.3)."""

CONTRASTS = """() => {
  const parse = (colour) => colour.match(/[\\d.]+/g).map(Number);
  const luminance = (rgb) => {
    const light = rgb.map((c) => (c / 255 <= 0.04045 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4));
    return 0.2126 * light[0] + 0.7152 * light[1] + 0.0722 * light[2];
  };
  const background = (element) => {
    for (let e = element; e; e = e.parentElement) {
      const [r, g, b, alpha = 1] = parse(getComputedStyle(e).backgroundColor);
      if (alpha === 1) return [r, g, b];
      if (alpha > 0) throw new Error("a half transparent background: blend it first");
    }
    throw new Error("no background");
  };
  const found = [];
  for (const element of document.body.querySelectorAll("*")) {
    const own = [...element.childNodes].some((n) => n.nodeType === Node.TEXT_NODE && n.textContent.trim());
    if (!own || !element.checkVisibility() || element.closest("script, .visually-hidden, .skip")) continue;
    const text = luminance(parse(getComputedStyle(element).color).slice(0, 3));
    const back = luminance(background(element));
    const contrast = (Math.max(text, back) + 0.05) / (Math.min(text, back) + 0.05);
    found.push({ text: element.textContent.trim().slice(0, 40), contrast });
  }
  return found;
}"""
