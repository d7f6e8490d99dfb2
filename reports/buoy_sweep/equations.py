"""What the buoy sweep solves, in the paper's letters; set once in Typst mathematics for the page and the PDF."""

from ..parts.content import Equation, Item, Text
from ..parts.wording import T_I

BUOY = Equation(
    "(M + M_a) (dif bold(U)) / (dif t) = (rho_w V + M_a) (dif bold(U)_w) / (dif t) + bold(B) - bold(W) - bold(T) - "
    "1/2 rho_w C_d A_p (bold(U) - bold(U)_w) abs(bold(U) - bold(U)_w)",
    "Mass and added mass times buoy acceleration equals displaced and added mass times water acceleration, plus "
    "buoyancy, minus weight, minus tether tension, minus quadratic drag on the relative velocity.",
    "30",
)
SPECTRUM = Equation(
    "Delta tilde(r) (omega) = 1 / (n T_i) integral_(tau_0)^(tau_0 + n T_i) Delta r(t) upright(e)^(upright(i) omega "
    "t) dif t",
    "The spectral amplitude at omega is the integral of the radial excursion times e to the i omega t over n wave "
    "periods from tau zero, divided by n wave periods.",
    "31",
)
LAWS = {
    "linear": Equation("T = f(epsilon) = p_1 epsilon", "Tension is p one times the strain.", "20"),
    "tanh": Equation(
        "T = f(epsilon) = p_1 tanh(p_2 epsilon + p_3) + p_4 + p_5 epsilon",
        "Tension is p one times the hyperbolic tangent of p two strain plus p three, plus p four, plus p five strain.",
        "20",
    ),
    "tabulated": Equation(
        'T = f(epsilon) quad upright("monotone cubic through the measured points")',
        "Tension is a monotone cubic through the measured points.",
        "20",
    ),
}
AIRY = Equation(
    "U_w = A omega (cosh k z) / (sinh k H) cos(k x - omega t), quad W_w = A omega (sinh k z) / (sinh k H) sin(k x - "
    "omega t), quad omega^2 = g k tanh k H",
    "The horizontal and vertical water velocities of the linear wave at height z above the bed, and its dispersion "
    "relation.",
)
MODES = Equation(
    "omega_r = sqrt((f'(epsilon_s)) / (l_0 (M + M_a))), quad omega_theta = sqrt(T_s / (l_0 (M + M_a))), quad "
    "f(epsilon_s) = T_s = B - W",
    "The radial and the pendulum natural frequency from the slope of the tension law and the static tension.",
)


_SOLVED = (
    "The tether is solved by finite differences along its unstretched length, with bending, drag and fluid inertia, in "
    "conservation form. At its upper end the buoy obeys",
    BUOY,
    "with the tension of the tether at its top, which follows the strain ε by",
    LAWS,  # stands for the one law of the scene
    f"The waves are linear, of finite depth, taken at the place where each node is (z from the bed, {T_I} = 2π/ω, A = "
    "(kA)/k):",
    AIRY,
    "Spectra are the paper's, a plain integral without a window, so that a sine of amplitude a shows as a/2:",
    SPECTRUM,
    "The marks in the spectra are the paper's estimates for small motions, with the mass of the rope left out:",
    MODES,
)


def equation_items(law: str) -> list[Item]:
    """The equations with the words between them; `law` is the scene's tension law."""
    items = (LAWS[law] if item is LAWS else item for item in _SOLVED)
    return [Text(item) if isinstance(item, str) else item for item in items]
