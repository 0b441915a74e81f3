// discrete_spectra: what is left of LOD spectra when only their discrete levels are wanted: a file leaves out
// what its scene does not need.
#pragma once

#include "lib/formats/levels/spectrum.h"

namespace copse {

// The spectra with two kinds of states alone, full detail and those of spectra.discrete; these draw the same
// triangles in the same order with the same errors. Elements that live in none of them are gone, and vertices
// that no element uses; steps count from state to state. There is no schedule. O(n log levels) in the
// elements and triangles.
LodSpectra discrete_spectra(const LodSpectra& spectra);

}  // namespace copse
