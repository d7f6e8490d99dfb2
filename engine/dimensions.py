"""One name for each pair of kernels of which one serves a plane and the other space (`engine.compiled.by_kind`).

Time stepping, Newton's method and output call these names, because they are the same in two and three dimensions. A
planar scene neither compiles nor runs anything of the third dimension.
"""

from .compiled import by_kind
from .planar import elimination as planar_elimination
from .planar import node as planar_node
from .planar import state as planar
from .spatial import elimination as spatial_elimination
from .spatial import node as spatial_node
from .spatial import state as spatial

shape = by_kind(planar_node.shape, spatial_node.shape)
work_arrays = by_kind(planar.work_arrays, spatial.work_arrays)
size_of = by_kind(planar.size_of, spatial.size_of)
node_quantities = by_kind(planar_node.node_quantities, spatial_node.node_quantities)
eliminate = by_kind(planar_elimination.eliminate, spatial_elimination.eliminate)
update_size = by_kind(planar.update_size, spatial.update_size)
add_update = by_kind(planar.add_update, spatial.add_update)
tidy = by_kind(planar.tidy, spatial.tidy)
conserved = by_kind(planar.conserved, spatial.conserved)
extrapolate = by_kind(planar.extrapolate, spatial.extrapolate)
error_square = by_kind(planar.error_square, spatial.error_square)
largest_turn = by_kind(planar.largest_turn, spatial.largest_turn)
release_loop = by_kind(planar.release_loop, spatial.release_loop)
configuration = by_kind(planar.configuration, spatial.configuration)
shear_force = by_kind(planar.shear_force, spatial.shear_force)
last_strain = by_kind(planar.last_strain, spatial.last_strain)
