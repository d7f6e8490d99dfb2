"""Tension laws T = f(eps), eq. (20), one file a law: a new file in this folder is a new value of tether.tension.law.

A law's file has

    Model                        the scene's table, a Section whose key `law` is Literal["name of the law"]
    faults(sound)                rules between the values of that table, as fault lines
    numbers(law)                 {field of engine.record.RECORD: number} and the law's table, a list of numbers
    value(eps, p, tables)        T (N) and dT/deps (N) at a strain; p: parameter record, tables: array of all tables
    integral(eps, p, tables)     of T from any fixed strain to eps, J per metre of unstretched line
    of_array(eps, p, tables)     as `value` for an array of complex strains, p a NumPy record (`engine.paper_box`)
    strain_under(load, law)      the strain that carries a load (N), where it has a closed form; else it is searched for
    IN_LANES                     False where `value` branches on eps: then its runs do not share a batch (`engine.simd`)

`value` and `integral` are compiled (`engine.physics.tension.kernels`): numbers, `math`, no calls of other functions.
"""

from ..laws import laws_in

LAWS, NAMES, TensionLaw = laws_in(__name__, __path__)
