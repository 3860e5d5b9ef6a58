"""Plots as SVG, by nothing but Python: lines with marks over two axes, and bars. Legible on light and dark pages."""

import math
from xml.sax.saxutils import escape

# Told apart by most eyes (Okabe & Ito), and dark and bright enough for either page.
COLORS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#8a7d00", "#56a0d3")
STYLE = """<style>
.paper { fill: #ffffff } .ink { fill: #1f2328 } .soft { fill: #59636e } .rule { stroke: #d1d9e0 } .axis { stroke: #59636e }
@media (prefers-color-scheme: dark) {
.paper { fill: #0d1117 } .ink { fill: #e6edf3 } .soft { fill: #9198a1 } .rule { stroke: #3d444d } .axis { stroke: #9198a1 } }
</style>"""
WIDTH, LEFT, RIGHT, TOP, HEIGHT, BELOW = 760, 78, 28, 64, 300, 92  # [px]; HEIGHT of the plot alone
NAMES, BAR, GAP = 310, 20, 10  # [px] room for the names of bars, a bar, between two


def text(x, y, words, anchor="start", kind="ink", size=13, more=""):
    return f'<text class="{kind}" x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" font-size="{size}"{more}>{escape(words)}</text>'


def page(height, title, about, commands, shapes):
    """`about` stands below, `commands` in the description that a reader of the file finds."""
    return "\n".join([
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{height}" viewBox="0 0 {WIDTH} {height}" font-family="sans-serif">',
        f"<title>{escape(title)}</title>", f"<desc>{escape(about)}&#10;{escape(chr(10).join(commands))}</desc>", STYLE,
        '<rect class="paper" width="100%" height="100%"/>', text(16, 24, title, size=15, more=' font-weight="bold"'),
        *shapes, text(16, height - 12, about, kind="soft", size=10), "</svg>", ""])


def legend(names, y):
    shapes, x = [], 16.0
    for name, color in zip(names, COLORS):
        shapes += [f'<rect x="{x:.1f}" y="{y - 10}" width="11" height="11" fill="{color}"/>', text(x + 16, y, name, size=12)]
        x += 34 + 6.8 * len(name)
    return shapes


def number(value):
    for limit, letter in ((1e9, "G"), (1e6, "M"), (1e3, "k")):
        if value >= limit:
            return f"{value / limit:.3g} {letter}"
    return f"{value:.3g}"


class Axis:
    """From numbers to pixels, even or by their logarithm, with round ticks."""

    def __init__(self, values, begin, end, by_logarithm):
        self.begin, self.end, self.by_logarithm = begin, end, by_logarithm
        values = [v for v in values if v > 0 or not by_logarithm] or [1.0]
        if by_logarithm:
            low, high = math.log10(min(values)), math.log10(max(values))
            room = 0.06 * (high - low) or 0.3
            self.low, self.high = low - room, high + room
            marks = [m * 10 ** e for e in range(math.floor(self.low), math.ceil(self.high) + 1) for m in (1, 2, 5)]
            self.ticks = [t for t in marks if self.low <= math.log10(t) <= self.high]
            if len(self.ticks) > 9:
                self.ticks = [t for t in self.ticks if f"{t:e}".startswith("1")]
        else:
            self.low, high = 0.0, max(values) or 1.0
            step = 10 ** math.floor(math.log10(high / 4))
            step *= next(m for m in (1, 2, 5, 10) if high / (m * step) <= 7)
            self.high = max(step * math.ceil(high / step), high)
            self.ticks = [step * i for i in range(round(self.high / step) + 1)]

    def at(self, value):
        place = math.log10(max(value, 1e-12)) if self.by_logarithm else value
        return self.begin + (self.end - self.begin) * (place - self.low) / (self.high - self.low)


def lines(title, across, upward, series, about, commands, logarithmic=(False, False)):
    """`series`: {name: [(x, median, p99)]}, a mark for each median, a stroke from it to its p99."""
    points = [point for row in series.values() for point in row]
    x = Axis([p[0] for p in points], LEFT, WIDTH - RIGHT, logarithmic[0])
    y = Axis([v for p in points for v in p[1:]], TOP + HEIGHT, TOP, logarithmic[1])
    shapes = legend(series, 46)
    for tick in x.ticks:
        shapes += [f'<line class="rule" x1="{x.at(tick):.1f}" x2="{x.at(tick):.1f}" y1="{TOP}" y2="{TOP + HEIGHT}"/>',
                   text(x.at(tick), TOP + HEIGHT + 17, number(tick), "middle", size=11)]
    for tick in y.ticks:
        shapes += [f'<line class="rule" x1="{LEFT}" x2="{WIDTH - RIGHT}" y1="{y.at(tick):.1f}" y2="{y.at(tick):.1f}"/>',
                   text(LEFT - 7, y.at(tick) + 4, number(tick), "end", size=11)]
    shapes += [f'<path class="axis" fill="none" d="M{LEFT} {TOP}V{TOP + HEIGHT}H{WIDTH - RIGHT}"/>',
               text((LEFT + WIDTH - RIGHT) / 2, TOP + HEIGHT + 38, across, "middle", size=12),
               text(0, 0, upward, "middle", size=12, more=f' transform="translate(20 {TOP + HEIGHT / 2}) rotate(-90)"')]
    for row, color in zip(series.values(), COLORS):
        row = sorted(row)
        places = [(x.at(a), y.at(median), y.at(p99)) for a, median, p99 in row]
        shapes.append('<polyline fill="none" stroke-width="2" stroke="%s" points="%s"/>' %
                      (color, " ".join(f"{a:.1f},{b:.1f}" for a, b, _ in places)))
        for a, b, c in places:
            shapes += [f'<line class="p99" stroke="{color}" x1="{a:.1f}" x2="{a:.1f}" y1="{b:.1f}" y2="{c:.1f}"/>',
                       f'<circle cx="{a:.1f}" cy="{b:.1f}" r="3.5" fill="{color}"/>']
    return page(TOP + HEIGHT + BELOW, title, about, commands, shapes)


def bars(title, along, parts, rows, about, commands):
    """`rows`: [(name, [a value for each of `parts`])], one bar of parts behind one another for each."""
    most = max((sum(values) for _, values in rows), default=0.0) or 1.0
    room = WIDTH - NAMES - RIGHT - 70
    shapes = legend(parts, 46) + [text(WIDTH - RIGHT, 46, along, "end", "soft", 11)]
    for index, (name, values) in enumerate(rows):
        top, x = TOP + index * (BAR + GAP), float(NAMES)
        shapes.append(text(NAMES - 8, top + 0.72 * BAR, name, "end", size=12))
        for value, color in zip(values, COLORS):
            width = room * value / most
            shapes.append(f'<rect class="bar" x="{x:.1f}" y="{top}" width="{width:.2f}" height="{BAR}" fill="{color}"/>')
            x += width
        shapes.append(text(x + 6, top + 0.72 * BAR, f"{sum(values):.3f}", size=11))
    return page(TOP + len(rows) * (BAR + GAP) + 36, title, about, commands, shapes)
