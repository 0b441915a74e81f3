// The box of an instance, from the bounding volumes of its tree: as tight as the tightest of them along each
// axis, and never smaller than the tree that they hold.
//
// A direction e of the world is A^T e in the tree, where A is the rotation as stored; how far the tree
// reaches that way is at most how far any volume that holds it does. So the box takes, side by side, the
// least reach of the type's box and of all its volumes. Source: digest 000, section 3.3 (boxes of whole
// instances), erratum E26 (what sways needs the envelope of its motion); support functions as in digest 002,
// section 3.
#pragma once

#include "lib/formats/ecosystem/ecosystem.h"

namespace copse {

// How far the volume reaches along `direction` (of any length) from the tree's origin: the largest dot
// product, but for some units in the last place of its size. +infinity for k-DOPs.
double reach_of(const Volume<float>& volume, const Double3& direction);

// Of the tree at rest, or, where the instance has a motion and the type has envelopes, of wherever it sways.
// Absolute, and wider by more than rounding can make of it. Empty when the type has no box.
DoubleBox instance_bounds(const TreeType& type, const Instance& instance);

}  // namespace copse
