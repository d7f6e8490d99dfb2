"""The paper's symbols with subscripts, as the texts of a report write them."""

from .content import sub

C_D = "C" + sub("d")  # buoy drag
C_DP, C_DT = "C" + sub("dp"), "C" + sub("dt")  # tether drag, normal and tangential
GI_P = "GI" + sub("p")  # torsion stiffness
L_0 = "l" + sub("0")  # unstretched length
M_A = "M" + sub("a")  # added mass of the buoy
OMEGA_I, OMEGA_R, OMEGA_THETA = ("ω" + sub(letter) for letter in ("i", "r", "θ"))  # wave, radial and pendulum frequency
P_1 = "p" + sub("1")  # stiffness of the linear tension law
RHO_W = "ρ" + sub("w")  # density of the water
TAU_0 = "τ" + sub("0")  # start of the spectral window
T_I = "T" + sub("i")  # wave period
T_S = "T" + sub("s")  # static tension
