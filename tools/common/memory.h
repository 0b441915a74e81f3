// How a tool that goes through large meshes asks for memory.
#pragma once

namespace copse {

// From now on an array of 12 MiB or more is a mapping of its own and goes back to the system when it is
// freed. Left to itself the C library moves that limit up to 32 MiB after the first such array is freed; what
// a stage leaves then lies scattered over what it needed meanwhile, and the next stage comes on top of it.
// Of the smaller ones up to 8 MiB are kept for the next: the system clears every page that it gives.
void return_large_arrays();

}  // namespace copse
