"""A search in a window, drawn by matplotlib."""

from __future__ import annotations

from typing import Any

import gymnasium
import numpy as np
from numpy.typing import NDArray

from earshot.errors import BadInput


def _pyplot() -> Any:
    try:
        from matplotlib import pyplot
    except ImportError as missing:
        raise gymnasium.error.DependencyNotInstalled(
            f"render_mode = 'human' draws with matplotlib: pip install matplotlib ({missing})"
        ) from None
    except ValueError as wrong:  # MPLBACKEND or a matplotlibrc
        raise _no_window(str(wrong)) from None
    return pyplot


def _has_window(figure: Any) -> bool:
    """A backend that draws files or pictures, such as a notebook's, has a manager that shows nothing."""
    from matplotlib.backend_bases import FigureManagerBase

    manager = figure.canvas.manager
    return manager is not None and type(manager).show is not FigureManagerBase.show


def _no_window(why: str) -> BadInput:
    return BadInput(
        f"render_mode = 'human': matplotlib can open no window here: {why}; render_mode = 'rgb_array' gives pictures"
        " without one",
        key="render_mode",
        value="human",
    )


class Window:
    """Opens at once. One that a person closes stays closed; what is drawn then is not shown.

    Raises gymnasium.error.DependencyNotInstalled where there is no matplotlib, BadInput where it can open no window.
    """

    def __init__(self, title: str, per_second: float) -> None:
        self._pause_s = 1.0 / per_second
        self._pyplot = _pyplot()
        try:
            self._figure = self._pyplot.figure(figsize=(5.0, 5.0))
        except Exception as failed:  # ImportError of matplotlib's, or an error of the window system's own
            raise _no_window(str(failed)) from None
        if not _has_window(self._figure):
            self.close()
            backend = self._pyplot.get_backend()
            raise _no_window(
                f"its backend {backend!r} has none, and it takes that by itself where it knows no display: set DISPLAY,"
                " or MPLBACKEND for another backend"
            )
        self._number = self._figure.number
        self._axes = self._figure.add_axes((0.0, 0.0, 1.0, 0.92))
        self._axes.set_axis_off()
        self._image: Any = None
        self._figure.canvas.manager.set_window_title(title)
        self._figure.show()

    def draw(self, picture: NDArray[np.uint8], caption: str) -> None:
        """Shows a picture, uint8 [height x width x 3], for as long as it stands: 1 / `per_second`."""
        if not self._pyplot.fignum_exists(self._number):
            return
        if self._image is None:
            self._image = self._axes.imshow(picture)
        self._image.set_data(picture)
        self._axes.set_title(caption, fontsize="x-small", wrap=True)
        self._figure.canvas.draw()
        self._figure.canvas.start_event_loop(self._pause_s)

    def close(self) -> None:
        self._pyplot.close(self._figure)
