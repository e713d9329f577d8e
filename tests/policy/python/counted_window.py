"""A backend of matplotlib's that opens windows nobody sees, and counts what they show.

MPLBACKEND=module://counted_window
"""

from typing import Any

import numpy as np
from matplotlib.backend_bases import FigureManagerBase
from matplotlib.backends.backend_agg import FigureCanvasAgg

shown: list[Any] = []  # a picture for each draw, uint8 [height x width x 4]
paused_s: list[float] = []
titles: list[str] = []
opened: list[bool] = []


class FigureManager(FigureManagerBase):
    def show(self) -> None:
        opened.append(True)

    def set_window_title(self, title: str) -> None:
        titles.append(title)


class FigureCanvas(FigureCanvasAgg):
    manager_class = FigureManager

    def draw(self) -> None:
        super().draw()
        shown.append(np.asarray(self.buffer_rgba()).copy())

    def start_event_loop(self, timeout: float = 0) -> None:
        paused_s.append(timeout)
