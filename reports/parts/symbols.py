"""Symbols of the paper with their subscripts."""

from tables import sub

L_0 = "l" + sub("0")  # unstretched length
OMEGA_I, OMEGA_R, OMEGA_THETA = ("ω" + sub(letter) for letter in ("i", "r", "θ"))  # wave, radial and pendulum frequency
RHO_W = "ρ" + sub("w")  # density of the water
TAU_0 = "τ" + sub("0")  # start of the spectral window
T_I = "T" + sub("i")  # wave period
T_S = "T" + sub("s")  # static tension
