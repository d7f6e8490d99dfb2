"""The choice between plane and space, made once for each name when a kernel is compiled (`engine.compiled`).

Shared parts of the engine call these names and know nothing of either kind of state; a scene in a plane compiles and
runs nothing of the third dimension.
"""

from .compiled import by_dimension
from .planar import node as planar_node
from .planar import state as planar
from .spatial import node as spatial_node
from .spatial import state as spatial

shape = by_dimension(planar_node.shape, spatial_node.shape)
work_arrays = by_dimension(planar.work_arrays, spatial.work_arrays)
size_of = by_dimension(planar.size_of, spatial.size_of)
assemble = by_dimension(planar.assemble, spatial.assemble)
update_size = by_dimension(planar.update_size, spatial.update_size)
add_update = by_dimension(planar.add_update, spatial.add_update)
tidy = by_dimension(planar.tidy, spatial.tidy)
conserved = by_dimension(planar.conserved, spatial.conserved)
extrapolate = by_dimension(planar.extrapolate, spatial.extrapolate)
error_square = by_dimension(planar.error_square, spatial.error_square)
largest_turn = by_dimension(planar.largest_turn, spatial.largest_turn)
release_loop = by_dimension(planar.release_loop, spatial.release_loop)
configuration = by_dimension(planar.configuration, spatial.configuration)
shear_force = by_dimension(planar.shear_force, spatial.shear_force)
last_strain = by_dimension(planar.last_strain, spatial.last_strain)
