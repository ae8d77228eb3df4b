"""What a reader can see of a chart, shared by the tests of the charts."""

from contextlib import contextmanager
from itertools import combinations

from matplotlib.axis import Axis
from matplotlib.colors import to_hex
from matplotlib.text import Text

from morphoskel.reporting.figure_page import figure_page

SMALLEST = 7.0
"""Points of type that can still be read in print."""


@contextmanager
def page(width, height):
    """Yield a figure in the style of all figures, and check afterwards that all of its words can be read."""
    with figure_page([], width, height) as figure:
        yield figure
        check_words(figure)


def check_words(figure):
    """Fail if a word is too small, leaves the page, or overlaps another one."""
    figure.draw_without_rendering()
    words = visible_words(figure)
    assert words
    boxes = [(word.get_text(), word.get_window_extent()) for word in words]
    for word, (text, box) in zip(words, boxes, strict=True):
        assert word.get_fontsize() >= SMALLEST, text
        assert min(box.x0, box.y0) >= -1, text
        assert box.x1 <= figure.bbox.x1 + 1, text
        assert box.y1 <= figure.bbox.y1 + 1, text
    for (text, box), (other, place) in combinations(boxes, 2):
        assert not box.padded(-1.0).overlaps(place), (text, other)


def visible_words(figure):
    """Return the texts that are drawn: those of ticks only where the tick is inside the axis."""
    of_ticks, drawn = set(), set()
    for axis in figure.findobj(Axis):
        low, high = sorted(axis.get_view_interval())
        for tick in (*axis.get_major_ticks(), *axis.get_minor_ticks()):
            of_ticks |= {tick.label1, tick.label2}
            if low <= tick.get_loc() <= high:
                drawn |= {tick.label1, tick.label2}
    return [
        text
        for text in figure.findobj(Text)
        if text.get_text().strip() and text.get_visible() and (text not in of_ticks or text in drawn)
    ]


def entries(figure):
    """Return the words of all legends."""
    legends = [*figure.legends, *(axes.get_legend() for axes in figure.axes if axes.get_legend())]
    return [text.get_text() for legend in legends for text in legend.get_texts()]


def lines_of(axes, colour, *, hollow=False):
    """Return the ``(x, y)`` lists of all lines of a colour with filled markers, or of all hollow markers."""
    return [
        (list(line.get_xdata()), list(line.get_ydata()))
        for line in axes.get_lines()
        if to_hex(line.get_color()) == colour
        and line.get_marker() not in ("None", "", None)
        and (line.get_markerfacecolor() == "white") == hollow
    ]
