// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/analysis/half_cycles.hpp"

#include <algorithm>
#include <cmath>

namespace seaway::analysis {
namespace {

/// Standard deviation of white noise on a smooth signal: second differences have sqrt(6) of it.
double noise_of(const Signal& s) {
  std::vector<double> difference;
  for (std::size_t i = 2; i < s.x.size(); ++i) difference.push_back(std::abs(s.x[i] - 2 * s.x[i - 1] + s.x[i - 2]));
  if (difference.empty()) return 0;
  const auto middle = difference.begin() + static_cast<std::ptrdiff_t>(difference.size() / 2);
  std::nth_element(difference.begin(), middle, difference.end());
  return *middle / 0.6745 / std::sqrt(6.0);  // median of |normal|
}

/// A stretch on one side of the level: between its ends the signal went over to the other side.
struct Side {
  std::size_t first_far = 0, last_far = 0;  ///< samples beyond the threshold
  double largest = 0;
};

std::vector<Side> split(const Signal& s, double level, double threshold) {
  std::vector<Side> out;
  int sign = 0;
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    const double x = s.x[i] - level;
    if (std::abs(x) <= threshold) continue;
    const int here = x > 0 ? 1 : -1;
    if (here != sign) out.push_back({i, i, 0});
    sign = here;
    out.back().last_far = i;
    out.back().largest = std::max(out.back().largest, std::abs(x));
  }
  return out;
}

/// By a straight line from the last sample beyond the threshold to the first one on the other side.
double first_guess(const Signal& s, double level, const Side& from, const Side& to) {
  const double x0 = s.x[from.last_far] - level, x1 = s.x[to.first_far] - level;
  return s.t[from.last_far] + (s.t[to.first_far] - s.t[from.last_far]) * x0 / (x0 - x1);
}

}  // namespace

HalfCycles find_half_cycles(const Signal& s, double level, double smallest) {
  HalfCycles out;
  if (s.x.size() < 8) return out;
  double first_peak = std::abs(s.x.front() - level);
  const double noise = noise_of(s);
  if (const auto rough = split(s, level, std::max(0.5 * first_peak, 4 * noise)); !rough.empty()) first_peak = rough.front().largest;
  const double threshold = std::max(smallest * first_peak, 4 * noise);
  if (!(threshold > 0)) return out;
  const auto sides = split(s, level, threshold);
  if (sides.size() < 2) return out;
  std::vector<double> guesses;
  for (std::size_t i = 0; i + 1 < sides.size(); ++i) guesses.push_back(first_guess(s, level, sides[i], sides[i + 1]));
  for (std::size_t i = 0; i < guesses.size(); ++i) {
    const double half_period = i > 0 ? guesses[i] - guesses[i - 1] : guesses.size() > 1 ? guesses[1] - guesses[0] : 2 * (guesses[0] - s.t.front());
    out.crossings.push_back(find_crossing(s, level, guesses[i], half_period / 4));
  }
  // The release: the motion begins at rest, so its first quarter cycle is about half a half cycle long.
  const double half_period = out.crossings.size() > 1 ? out.crossings[1] - out.crossings[0] : 2 * (out.crossings[0] - s.t.front());
  const double lead = out.crossings[0] - s.t.front();
  out.from_release = std::abs(s.x.front() - level) > 0.97 * sides.front().largest - 3 * noise && lead > 0.35 * half_period &&
                     lead < 0.75 * half_period;
  if (out.from_release) out.turns.push_back({s.t.front(), value_at_release(s, half_period / 4)});
  for (std::size_t i = 0; i + 1 < out.crossings.size(); ++i)
    out.turns.push_back(find_turning_point(s, level, 0.5 * (out.crossings[i] + out.crossings[i + 1]), half_period / 4));
  return out;
}

}  // namespace seaway::analysis
