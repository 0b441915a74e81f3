// The project's random streams: small, splittable, the same on every machine.
//
// A stream is a SplitMix64 sequence with its own start and its own odd increment, both mixed from the seed
// and the keys that lead to it. What is drawn from one stream never depends on what was drawn from another:
// fork a stream for every element (a branch, a leaf, a row of pixels) and the result does not depend on the
// order, or the number of threads, in which the elements are made.
//
// Source: Steele, Lea, Flood, "Fast splittable pseudorandom number generators" (OOPSLA 2014). Not for
// cryptography. Cost: a multiplication or two a number; 16 bytes a stream.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

namespace copse {

class Random {
 public:
  explicit Random(std::uint64_t seed);

  // An independent stream for `key`; does not advance this one and does not depend on how far it has gone.
  Random fork(std::uint64_t key) const;

  std::uint64_t next() { return mix(state_ += increment_); }

  // Uniform in [0, 1), a multiple of 2^-53.
  double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  // Uniform in [a, b); a when a == b.
  double uniform(double a, double b) { return a + (b - a) * uniform(); }
  // Uniform in [mean - spread, mean + spread).
  double around(double mean, double spread) { return uniform(mean - spread, mean + spread); }
  // Uniform in 0 .. n - 1, without bias; n > 0.
  std::uint64_t below(std::uint64_t n);
  // True with probability p.
  bool chance(double p) { return uniform() < p; }
  // `x` rounded down or up, up with probability x - floor(x): its mean is x. |x| < 2^62.
  std::int64_t round(double x);

  // A permutation, each equally likely (Fisher-Yates).
  template <class T>
  void shuffle(std::span<T> elements) {
    for (std::size_t n = elements.size(); n > 1; --n) std::swap(elements[n - 1], elements[below(n)]);
  }

  // SplitMix64's finalizer: a bijection of 64 bits in which every input bit moves half of the output bits.
  static std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

 private:
  Random(std::uint64_t state, std::uint64_t increment);
  std::uint64_t key_;  // what the stream was made from: fork() starts here, wherever state_ is
  std::uint64_t state_;
  std::uint64_t increment_;  // odd
};

}  // namespace copse
