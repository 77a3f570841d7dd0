"""From the angles of a chain to the places of its joints, and how these follow the angles."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from canim._arguments import Floats, finite, floats
from canim.character._chain import accumulated, chain, flat_rotations, rotations

__all__ = [
    "forward_kinematics_2d",
    "forward_kinematics_3d",
    "jacobian_2d",
    "jacobian_3d",
    "joint_transforms",
    "numeric_jacobian",
]


def forward_kinematics_2d(
    angles: ArrayLike, offsets: ArrayLike, root: ArrayLike = (0, 0)
) -> Floats:
    r"""Find the places of all joints of a flat chain.

    Every joint turns all links behind it, so that link i has turned by the sum of the angles up
    to its own:

    .. math::

        \mathbf{p}_0 = \text{root}, \qquad
        \mathbf{p}_i = \mathbf{p}_{i-1}
            + \mathbf{R}(\theta_1 + \dots + \theta_i)\, \mathbf{z}_i.

    Parameters
    ----------
    angles : array_like, shape (N,)
        The angle of each joint in radians, counter-clockwise.
    offsets : array_like, shape (N, 2)
        Each link :math:`\mathbf{z}_i` in the rest pose, from its joint to the next. Links in a
        straight arm that points up are (0, length).
    root : array_like, shape (2,), default: (0, 0)
        The place of the first joint.

    Returns
    -------
    ndarray, shape (N + 1, 2)
        The root, the other joints, the end effector.

    Raises
    ------
    TypeError
        If an argument does not hold real numbers.
    ValueError
        If shapes do not fit each other, there is no link, a link has no length, a number is not
        finite, or the result does not fit a float.

    See Also
    --------
    joint_transforms : The same as matrices, with the rotations.

    Notes
    -----
    Theory: :ref:`Task 3.1 <task-3-1>`.

    Examples
    --------
    >>> import numpy as np
    >>> from canim.character import forward_kinematics_2d
    >>> forward_kinematics_2d(np.radians([90, -90]), [(2, 0), (1, 0)]).round(9) + 0
    array([[0., 0.],
           [0., 2.],
           [1., 2.]])
    """
    return _pose(*chain(angles, offsets, root, 2))[1]


def forward_kinematics_3d(
    angles: ArrayLike, offsets: ArrayLike, root: ArrayLike = (0, 0, 0)
) -> Floats:
    r"""Find the places of all joints of a chain in space.

    A joint has three angles; its rotation is :math:`\mathbf{R}_i = \mathbf{R}_x(\alpha_i)
    \mathbf{R}_y(\beta_i) \mathbf{R}_z(\gamma_i)`. Every joint turns all links behind it:

    .. math::

        \mathbf{p}_0 = \text{root}, \qquad
        \mathbf{p}_i = \mathbf{p}_{i-1} + \mathbf{R}_1 \cdots \mathbf{R}_i\, \mathbf{z}_i.

    Parameters
    ----------
    angles : array_like, shape (N, 3)
        The three angles of each joint, about x, y and z, in radians, counter-clockwise for who
        looks against the axis.
    offsets : array_like, shape (N, 3)
        Each link :math:`\mathbf{z}_i` in the rest pose, from its joint to the next.
    root : array_like, shape (3,), default: (0, 0, 0)
        The place of the first joint.

    Returns
    -------
    ndarray, shape (N + 1, 3)
        The root, the other joints, the end effector.

    Raises
    ------
    TypeError
        If an argument does not hold real numbers.
    ValueError
        If shapes do not fit each other, there is no link, a link has no length, a number is not
        finite, or the result does not fit a float.

    See Also
    --------
    joint_transforms : The same as matrices, with the rotations.

    Notes
    -----
    Theory: :ref:`Task 3.3 <task-3-3>`.

    Examples
    --------
    >>> import numpy as np
    >>> from canim.character import forward_kinematics_3d
    >>> angles = np.radians([(90, 0, 0), (0, 90, 0)])
    >>> forward_kinematics_3d(angles, [(0, 0, 2), (0, 0, 1)]).round(9) + 0
    array([[ 0.,  0.,  0.],
           [ 0., -2.,  0.],
           [ 1., -2.,  0.]])
    """
    return _pose(*chain(angles, offsets, root, 3))[1]


def joint_transforms(
    angles: ArrayLike, offsets: ArrayLike, root: ArrayLike | None = None
) -> Floats:
    r"""Accumulate the transforms along a chain, in the plane or in space.

    The transform of one link is :math:`\mathbf{T}_i = \mathbf{R}_i \mathbf{Z}_i`: move along the
    link, then turn about the joint, as matrices act from the right one to the left one. The
    product of the first i of them says where link i ends and how it lies:

    .. math::

        {}^0\mathbf{T}_i = \mathbf{Z}_\text{root}\, \mathbf{T}_1 \mathbf{T}_2 \cdots \mathbf{T}_i
        = \begin{bmatrix}
            \mathbf{R}_1 \cdots \mathbf{R}_i & \mathbf{p}_i \\ \mathbf{0} & 1
          \end{bmatrix}

    Parameters
    ----------
    angles : array_like, shape (N,) or (N, 3)
        In the plane one angle a joint, in space three (about x, y and z), in radians.
    offsets : array_like, shape (N, d)
        Each link in the rest pose, from its joint to the next; d is 2 or 3.
    root : array_like, shape (d,), optional
        The place of the first joint; without it the origin.

    Returns
    -------
    ndarray, shape (N + 1, d + 1, d + 1)
        One matrix for the root, then one for the end of every link. They act on columns
        :math:`[x, y, 1]^\mathsf{T}` or :math:`[x, y, z, 1]^\mathsf{T}`.

    Raises
    ------
    TypeError
        If an argument does not hold real numbers.
    ValueError
        If shapes do not fit each other, there is no link, a link has no length, a number is not
        finite, or the result does not fit a float.

    Notes
    -----
    Theory: :ref:`Task 3.1 <task-3-1>`. This is simpler than the notation of Denavit and
    Hartenberg, which gives a link four numbers and makes every joint turn about the z axis of
    its own frame.

    References
    ----------
    J. Kay, *Introduction to Homogeneous Transformations and Robot Kinematics*, 2005.

    Examples
    --------
    >>> import numpy as np
    >>> from canim.character import joint_transforms
    >>> joint_transforms(np.radians([90]), [(2, 0)], root=(5, 6)).round(9) + 0
    array([[[ 1.,  0.,  5.],
            [ 0.,  1.,  6.],
            [ 0.,  0.,  1.]],
    <BLANKLINE>
           [[ 0., -1.,  5.],
            [ 1.,  0.,  8.],
            [ 0.,  0.,  1.]]])
    """
    turned, positions = _pose(*chain(angles, offsets, root))
    count, dimension = positions.shape
    transforms = np.tile(np.eye(dimension + 1), (count, 1, 1))
    transforms[1:, :-1, :-1] = turned
    transforms[:, :-1, -1] = positions
    return transforms


def numeric_jacobian(
    function: Callable[[Floats], ArrayLike], angles: ArrayLike, step: float = 1e-6
) -> Floats:
    r"""Measure how a point moves when each angle turns a little.

    Column k is a central difference: turn angle k a little forward and a little back, and divide
    the way of the point by the turn,

    .. math::

        \mathbf{J}_k = \frac{\mathbf{p}(\dots, \theta_k + \varepsilon, \dots)
            - \mathbf{p}(\dots, \theta_k - \varepsilon, \dots)}{2 \varepsilon}.

    Parameters
    ----------
    function : callable
        Takes an array of the shape of `angles` and returns a point, shape (d,). It may change
        its array.
    angles : array_like
        Where to measure, in radians; any shape, with n numbers.
    step : float, default: 1e-6
        The turn :math:`\varepsilon` in radians.

    Returns
    -------
    ndarray, shape (d, n)
        One column an angle, in the order of ``angles.ravel()``.

    Raises
    ------
    TypeError
        If `function` cannot be called or does not return real numbers, or another argument does
        not hold real numbers.
    ValueError
        If `angles` is empty, `step` is not above 0 or too small to change an angle, or
        `function` returns something that is not one point of finite numbers.

    Notes
    -----
    Theory: :ref:`Task 3.2 <task-3-2>`.

    Examples
    --------
    >>> from canim.character import forward_kinematics_2d, numeric_jacobian
    >>> def effector(angles):
    ...     return forward_kinematics_2d(angles, [(2, 0), (1, 0)])[-1]
    >>> numeric_jacobian(effector, [0, 0]).round(6) + 0
    array([[0., 0.],
           [3., 1.]])
    """
    if not callable(function):
        raise TypeError(f"function must be a function of the angles, but is {function!r}.")
    start = floats(angles, "angles")
    if start.size == 0:
        raise ValueError("angles needs 1 or more numbers, but has 0.")
    turn = floats(step, "step")
    if turn.ndim or turn <= 0:
        raise ValueError(f"step must be one number above 0, but is {step!r}.")
    if (start + turn == start - turn).any():
        raise ValueError(f"step is {step!r}, too small to change an angle of {abs(start).max()}.")

    def point(k: int, sign: int) -> Floats:
        turned = start.copy()
        turned.flat[k] += sign * turn
        return floats(function(turned), "the result of function")

    columns = []
    for k in range(start.size):
        ahead, behind = point(k, 1), point(k, -1)
        if ahead.ndim != 1 or ahead.size == 0 or ahead.shape != behind.shape:
            raise ValueError(
                "function must return one point, shape (d,), "
                f"but returns the shapes {ahead.shape} and {behind.shape}."
            )
        with np.errstate(over="ignore"):
            columns.append((ahead - behind) / (2 * turn))
    return finite(np.stack(columns, axis=1), "function")


def jacobian_2d(angles: ArrayLike, offsets: ArrayLike) -> Floats:
    r"""Find how the end effector of a flat chain moves when each joint turns a little.

    The end effector :math:`\mathbf{p}` goes round the joint :math:`\mathbf{p}_{k-1}` in a
    circle: its velocity is the arm between them, turned by a right angle.

    .. math::

        \mathbf{J}_k = \frac{\partial \mathbf{p}}{\partial \theta_k}
        = \begin{bmatrix} -(y - y_{k-1}) \\ x - x_{k-1} \end{bmatrix}

    Parameters
    ----------
    angles : array_like, shape (N,)
        The angle of each joint in radians, counter-clockwise.
    offsets : array_like, shape (N, 2)
        Each link in the rest pose, from its joint to the next.

    Returns
    -------
    ndarray, shape (2, N)
        One column a joint, in units of length per radian.

    Raises
    ------
    TypeError
        If an argument does not hold real numbers.
    ValueError
        If shapes do not fit each other, there is no link, a link has no length, a number is not
        finite, or the result does not fit a float.

    Notes
    -----
    Theory: :ref:`Task 3.2 <task-3-2>`.

    References
    ----------
    S. R. Buss, *Introduction to Inverse Kinematics with Jacobian Transpose, Pseudoinverse and
    Damped Least Squares Methods*, 2004.

    Examples
    --------
    >>> from canim.character import jacobian_2d
    >>> jacobian_2d([0, 0], [(2, 0), (1, 0)]) + 0
    array([[0., 0.],
           [3., 1.]])
    """
    joints = forward_kinematics_2d(angles, offsets)
    with np.errstate(over="ignore"):
        x, y = (joints[-1] - joints[:-1]).T
    return finite(np.stack([-y, x]), "offsets")


def jacobian_3d(angles: ArrayLike, offsets: ArrayLike) -> Floats:
    r"""Find how the end effector of a chain in space moves when each angle turns a little.

    The end effector :math:`\mathbf{p}` goes round an axis :math:`\mathbf{a}` through the joint
    :math:`\mathbf{p}_{k-1}`:

    .. math:: \frac{\partial \mathbf{p}}{\partial \theta}
        = \mathbf{a} \times (\mathbf{p} - \mathbf{p}_{k-1})

    The three axes of a joint are the x axis as all earlier joints have turned it, the y axis
    turned by the joint's :math:`\mathbf{R}_x` too, and the z axis turned by
    :math:`\mathbf{R}_x \mathbf{R}_y` too.

    Parameters
    ----------
    angles : array_like, shape (N, 3)
        The three angles of each joint, about x, y and z, in radians.
    offsets : array_like, shape (N, 3)
        Each link in the rest pose, from its joint to the next.

    Returns
    -------
    ndarray, shape (3, 3 N)
        One column an angle, in the order of ``angles.ravel()``, in units of length per radian.

    Raises
    ------
    TypeError
        If an argument does not hold real numbers.
    ValueError
        If shapes do not fit each other, there is no link, a link has no length, a number is not
        finite, or the result does not fit a float.

    Notes
    -----
    Theory: :ref:`Task 3.3 <task-3-3>`.

    References
    ----------
    S. R. Buss, *Introduction to Inverse Kinematics with Jacobian Transpose, Pseudoinverse and
    Damped Least Squares Methods*, 2004.

    Examples
    --------
    >>> from canim.character import jacobian_3d
    >>> jacobian_3d([(0, 0, 0)], [(0, 0, 2)]) + 0
    array([[ 0.,  2.,  0.],
           [-2.,  0.,  0.],
           [ 0.,  0.,  0.]])
    """
    angles, offsets, root = chain(angles, offsets, None, 3)
    after, joints = _pose(angles, offsets, root)
    before = np.concatenate([np.eye(3)[None], after[:-1]])
    cosine, sine = np.cos(angles[:, 0, None]), np.sin(angles[:, 0, None])
    axes = [before[:, :, 0], cosine * before[:, :, 1] + sine * before[:, :, 2], after[:, :, 2]]
    with np.errstate(over="ignore", invalid="ignore"):
        arms = joints[-1] - joints[:-1]
        columns = np.cross(np.stack(axes, axis=1), arms[:, None])
    return finite(columns.reshape(-1, 3).T, "offsets")


def _pose(angles: Floats, offsets: Floats, root: Floats) -> tuple[Floats, Floats]:
    """Return how every link lies, (N, d, d), and where the joints are, (N + 1, d)."""
    with np.errstate(over="ignore", invalid="ignore"):
        turned = flat_rotations(angles) if angles.ndim == 1 else accumulated(rotations(angles))[1:]
        links = np.einsum("nij,nj->ni", turned, offsets)
        positions = np.cumsum(np.concatenate([root[None], links]), axis=0)
    return turned, finite(positions, "angles, offsets and root")
