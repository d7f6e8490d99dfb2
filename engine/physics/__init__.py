"""Laws, one file a law: tension, waves, irregular seas, currents, ends, buoyancy at the surface, shocks, energy."""
