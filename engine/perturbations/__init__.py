"""Perturbations carried along accepted steps: tangent dynamics in the plane, lateral motion, their exponents."""
