"""Interpolation: Hermite, Lagrange, quadratic splines and Bézier curves (Tasks 1.1 to 1.9)."""

from canim.interpolation.arc_length import (
    arc_length,
    equidistant_parameters,
    equidistant_points,
)
from canim.interpolation.bezier import (
    bernstein_basis,
    bezier_curve,
    bezier_path,
    de_casteljau,
    joint_kinks,
    next_control_point,
    transform_points,
)
from canim.interpolation.hermite import (
    HERMITE_MATRIX,
    hermite_basis,
    hermite_coefficients,
    hermite_curve,
    hermite_spline,
)
from canim.interpolation.lagrange import lagrange_basis, lagrange_interpolate
from canim.interpolation.linear import lerp
from canim.interpolation.quadratic_spline import (
    QuadraticSpline,
    quadratic_spline,
    quadratic_spline_system,
)

__all__ = [
    "HERMITE_MATRIX",
    "QuadraticSpline",
    "arc_length",
    "bernstein_basis",
    "bezier_curve",
    "bezier_path",
    "de_casteljau",
    "equidistant_parameters",
    "equidistant_points",
    "hermite_basis",
    "hermite_coefficients",
    "hermite_curve",
    "hermite_spline",
    "joint_kinks",
    "lagrange_basis",
    "lagrange_interpolate",
    "lerp",
    "next_control_point",
    "quadratic_spline",
    "quadratic_spline_system",
    "transform_points",
]
