"""What is wrong with a figure, by what is drawn: each check yields a sentence for each fault."""

import re

import matplotlib.collections
import matplotlib.colors
import matplotlib.lines
import matplotlib.quiver
import matplotlib.text
import matplotlib.ticker
import numpy

LEAST_SHARE = 0.2  # of an axis, that its numbers take
MOST_CURVES = 8  # of one axes
LEAST_CONTRAST = 3.0  # WCAG 2.1, criterion 1.4.11
ROUNDING_PX = 1.0
APART_PX = 2.0  # of 100 an inch: labels of ticks that are nearer read as one


def points_of(axes):
    """(x, y) of all that is drawn by its numbers; lines through the whole axes are none."""
    found = []
    for line in axes.lines:
        if line.get_transform() == axes.transData:
            found.append(line.get_xydata())
    for collection in axes.collections:
        offsets = collection.get_offset_transform() == axes.transData
        if offsets:
            found.append(numpy.ma.filled(collection.get_offsets().astype(float), numpy.nan))
        elif collection.get_transform() == axes.transData:
            found += [path.vertices for path in collection.get_paths()]
    for patch in axes.patches:
        found.append(patch.get_path().transformed(patch.get_patch_transform()).vertices)
    found = numpy.concatenate([numpy.empty((0, 2)), *map(numpy.asarray, found)])
    return found[numpy.isfinite(found).all(axis=1)]


def is_colorbar(axes):
    return hasattr(axes, "_colorbar")


def places(axis, values):
    """Between the ends of an axis: 0 and 1."""
    low, high, *values = axis.get_transform().transform([*axis.get_view_interval(), *values])
    return (numpy.array(values) - low) / (high - low)


def together(axis_name, axes):
    """The axes that have this axis in common."""
    shared = axes.get_shared_x_axes() if axis_name == "x" else axes.get_shared_y_axes()
    return shared.get_siblings(axes)


def data_out_of_view(figure):
    for axes in figure.axes:
        if is_colorbar(axes):
            continue
        if len(points_of(axes)) == 0:
            yield f"axes of \"{axes.get_ylabel()}\" and \"{axes.get_xlabel()}\" are empty"
            continue
        for k, axis in enumerate((axes.xaxis, axes.yaxis)):
            values = numpy.concatenate([points_of(each)[:, k] for each in together("xy"[k], axes)])
            own = places(axis, values)
            low, high, share = own.min(), own.max(), taken(axis, own)
            of_axis = f"of an axis ({axis.get_label_text()})"
            if low < -1e-6 or high > 1 + 1e-6:
                yield f"numbers reach from {low:.3g} to {high:.3g} {of_axis}"
            differ = numpy.ptp(values) > 1e-9 * numpy.abs(values).max()
            if differ and share < LEAST_SHARE:
                yield f"numbers take {share:.3g} {of_axis}"


def taken(axis, own):
    """The share of an axis between its numbers; of one that shows zero, from there: what is small
    is to look small. An axis of names is as long as they are many."""
    if isinstance(axis.get_major_locator(), matplotlib.ticker.FixedLocator):
        return 1.0
    low, high = sorted(axis.get_view_interval())
    if axis.get_scale() == "linear" and low <= 0 <= high:
        own = numpy.append(own, places(axis, [0.0]))
    return numpy.ptp(own)


def ticks_of(axis):
    low, high = sorted(axis.get_view_interval())
    return [tick for tick in [*axis.get_major_ticks(), *axis.get_minor_ticks()]
            if tick.get_visible() and low <= tick.get_loc() <= high]


def texts_of(figure):
    """All that can be read."""
    of_ticks, shown = set(), set()
    for axes in figure.axes:
        for axis in (axes.xaxis, axes.yaxis):
            for tick in [*axis.get_major_ticks(), *axis.get_minor_ticks()]:
                of_ticks |= {tick.label1, tick.label2}
            shown |= {label for tick in ticks_of(axis) for label in (tick.label1, tick.label2)}
    keys = [key.text for key in figure.findobj(matplotlib.quiver.QuiverKey)]
    return [text for text in [*figure.findobj(matplotlib.text.Text), *keys]
            if text.get_visible() and text.get_text().strip()
            and (text not in of_ticks or text in shown)]


def box_of(artist):
    return artist.get_window_extent(artist.figure.canvas.get_renderer())


def texts_out_of_canvas(figure):
    canvas = figure.bbox
    for text in texts_of(figure):
        box = box_of(text)
        if (box.x0 < canvas.x0 - ROUNDING_PX or box.x1 > canvas.x1 + ROUNDING_PX
                or box.y0 < canvas.y0 - ROUNDING_PX or box.y1 > canvas.y1 + ROUNDING_PX):
            yield f"\"{text.get_text()}\" is cut off"


def texts_on_texts(figure):
    boxes = [(text.get_text(), box_of(text).padded(-ROUNDING_PX)) for text in texts_of(figure)]
    for k, (one, box) in enumerate(boxes):
        for other, other_box in boxes[k + 1:]:
            if box.overlaps(other_box):
                yield f"\"{one}\" and \"{other}\" overlap"


def ticks_in_one(figure):
    for axis in (axis for axes in figure.axes for axis in (axes.xaxis, axes.yaxis)):
        labels = [tick.label1 for tick in ticks_of(axis)
                  if tick.label1.get_visible() and tick.label1.get_text()]
        boxes = [box_of(label).padded(0.5 * APART_PX) for label in labels]
        for k, box in enumerate(boxes):
            if any(box.overlaps(other) for other in boxes[k + 1:]):
                yield f"\"{labels[k].get_text()}\" touches another tick's label"


def legends_of(figure):
    return [*figure.legends, *(axes.legend_ for axes in figure.axes if axes.legend_)]


def legends_in_the_way(figure):
    renderer = figure.canvas.get_renderer()
    boxes = [legend.get_window_extent(renderer) for legend in legends_of(figure)]
    for k, box in enumerate(boxes):
        if any(box.overlaps(axes.get_window_extent(renderer)) for axes in figure.axes):
            yield "a legend hides what axes show"
        if any(box.overlaps(other) for other in boxes[k + 1:]):
            yield "a legend covers another"


def luminance(colour):
    """WCAG 2.1, relative luminance; of a colour on white paper."""
    *red_green_blue, alpha = matplotlib.colors.to_rgba(colour)
    seen = alpha * numpy.array(red_green_blue) + (1 - alpha)
    linear = numpy.where(seen <= 0.03928, seen / 12.92, ((seen + 0.055) / 1.055) ** 2.4)
    return linear @ (0.2126, 0.7152, 0.0722)


def colours_of(handle):
    """Those that a mark of a legend is drawn with."""
    if isinstance(handle, matplotlib.lines.Line2D):
        colours = [handle.get_color()] if handle.get_linestyle() not in ("None", "") else []
        if handle.get_marker() not in ("None", "", None):
            colours += [handle.get_markeredgecolor(), handle.get_markerfacecolor()]
        return [matplotlib.colors.to_rgba(c, handle.get_alpha()) for c in colours if c != "none"]
    return [*numpy.atleast_2d(handle.get_facecolor()), *numpy.atleast_2d(handle.get_edgecolor())]


def pale_marks(figure):
    for legend in legends_of(figure):
        for handle, text in zip(legend.legendHandles, legend.get_texts()):
            contrast = max((1.05 / (luminance(c) + 0.05) for c in colours_of(handle)), default=1.0)
            if contrast < LEAST_CONTRAST:
                yield f"the mark of \"{text.get_text()}\" has a contrast of {contrast:.2g}"


def look_of(line):
    return (matplotlib.colors.to_rgba(line.get_color()), str(line._unscaled_dash_pattern),
            line.get_marker() if line.get_marker() != "" else "None")


def same_looks(figure):
    """Of curves that a legend names; tracks over ground are told apart by where they lead."""
    for axes in figure.axes:
        looks = [look_of(line) for line in axes.lines if not line.get_label().startswith("_")]
        if len(set(looks)) < len(looks):
            yield f"{len(looks)} curves have {len(set(looks))} looks"
        if len(looks) > MOST_CURVES:
            yield f"{len(looks)} curves are more than can be followed"
    for legend in legends_of(figure):
        names = [text.get_text() for text in legend.get_texts()]
        if len(set(names)) < len(names):
            yield f"a legend says the same twice: {names}"


def odd_words(figure):
    for text in texts_of(figure):
        said = text.get_text()
        if re.search(r"[A-Za-z0-9]_[A-Za-z0-9]", said) and "$" not in said:
            yield f"\"{said}\" is a name of the program"
        if re.search(r"\b([\w/]+) \(\1\)", said):
            yield f"\"{said}\" says its unit twice"
    axes = [each for each in figure.axes if not is_colorbar(each)]
    if not any(each.get_xlabel() for each in axes):
        yield "no axis says what runs along it"


CHECKS = (data_out_of_view, texts_out_of_canvas, texts_on_texts, ticks_in_one,
          legends_in_the_way, pale_marks, same_looks, odd_words)


def faults(figure):
    return [fault for check in CHECKS for fault in check(figure)]
