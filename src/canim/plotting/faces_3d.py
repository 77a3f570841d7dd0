"""Faces, rendered by pyvista. Imported only where pyvista is installed and can render."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pyvista
from matplotlib.artist import Artist
from numpy.typing import NDArray

from canim.plotting.faces import AMBIENT, LIGHTS, SHARPNESS, SHINE


class Rendered(Artist):
    """Triangles that fill their axes with a picture, made whenever the axes are drawn."""

    def __init__(self, points: Any, normals: Any, colors: Any, faces: Any) -> None:
        super().__init__()
        self._mesh = pyvista.PolyData.from_regular_faces(points, faces)
        self._mesh.point_data["colors"] = (255 * colors).round().astype(np.uint8)
        self._mesh.point_data.active_normals = normals
        self._view: tuple[float, ...] = ()
        self._picture: NDArray[np.uint8] | None = None

    def draw(self, renderer: Any) -> None:
        """Draw the picture, pixel for pixel."""
        axes: Any = self.axes
        box = np.round(axes.bbox.extents).astype(int)
        view = (*(box[2:] - box[:2]).tolist(), *axes.axis(), *axes.get_facecolor())
        # A figure that is saved is drawn twice.
        if view != self._view:
            self._view, self._picture = view, _picture(self._mesh, *view)
        renderer.draw_image(renderer.new_gc(), *box[:2], self._picture)


def _picture(
    mesh: Any,
    width: int,
    height: int,
    left: float,
    right: float,
    bottom: float,
    top: float,
    *ground: float,
) -> NDArray[np.uint8]:
    """Return a picture with alpha, bottom row first, of what is within the limits."""
    plotter = _plotter()
    actor = plotter.add_mesh(
        mesh,
        name="face",
        scalars="colors",
        rgb=True,
        ambient=AMBIENT,
        specular=SHINE,
        specular_power=SHARPNESS,
        culling="back",
        reset_camera=False,
        render=False,
    )
    actor.prop.interpolation = "Phong"
    plotter.set_background(ground[:3])
    if list(plotter.window_size) != [width, height]:
        plotter.window_size = [width, height]  # this renders, too
    middle = (left + right) / 2, (bottom + top) / 2
    far = float(np.abs(mesh.points).max())
    plotter.camera.position = (*middle, 2 * far)
    plotter.camera.focal_point = (*middle, 0)
    plotter.camera.parallel_scale = (top - bottom) / 2
    plotter.camera.clipping_range = (far / 2, 4 * far)
    plotter.render()
    picture: NDArray[np.uint8] = plotter.screenshot(return_img=True)
    solid = np.full((*picture.shape[:2], 1), 255, dtype=np.uint8)
    return np.concatenate([picture, solid], axis=2)[::-1]


@cache
def _plotter() -> Any:
    """Return camera and lights: to make these takes longer than to render a picture."""
    plotter = pyvista.Plotter(off_screen=True, lighting="none")
    for direction, strength in LIGHTS:
        light = pyvista.Light(position=direction, intensity=strength)
        light.positional = False
        plotter.add_light(light)
    plotter.camera.up = (0, 1, 0)
    plotter.camera.parallel_projection = True
    return plotter
