#include "core/hull/section_patch.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"

namespace seaway::hull {

namespace {

/// Area and moments of the solid in |u| <= a, |v| <= b, added up edge by edge (see header).
struct Slices {
  double a, b;
  double area = 0, moment_u = 0, moment_v = 0;

  /// From (u0, v0) to (u1, v1), already inside |v| <= b and on one side of both u = a and u = -a.
  void add_piece(double u0, double v0, double u1, double v1) {
    const double dv = v1 - v0;
    const double c0 = std::clamp(u0, -a, a), c1 = std::clamp(u1, -a, a);
    area += 0.5 * dv * (c0 + c1);
    moment_u += dv * (c0 * c0 + c0 * c1 + c1 * c1) * (1.0 / 6.0);
    moment_v += dv * (c0 * (2 * v0 + v1) + c1 * (v0 + 2 * v1)) * (1.0 / 6.0);
  }

  void add_edge(double u0, double v0, double u1, double v1) {
    if (v0 == v1 || (v0 >= b && v1 >= b) || (v0 <= -b && v1 <= -b)) return;
    const double slope = (u1 - u0) / (v1 - v0);
    const double start_u = u0, start_v = v0;
    const auto cut = [&](double& u, double& v) {
      if (v > b) {
        u = start_u + (b - start_v) * slope;
        v = b;
      } else if (v < -b) {
        u = start_u + (-b - start_v) * slope;
        v = -b;
      }
    };
    cut(u0, v0);
    cut(u1, v1);
    const bool split_high = (u0 > a) != (u1 > a), split_low = (u0 < -a) != (u1 < -a);
    if (!split_high && !split_low) return add_piece(u0, v0, u1, v1);
    const double t_high = split_high ? (a - u0) / (u1 - u0) : 0.0;
    const double t_low = split_low ? (-a - u0) / (u1 - u0) : 0.0;
    double t[2] = {std::min(t_high, t_low), std::max(t_high, t_low)};
    if (!split_high || !split_low) t[0] = t[1];
    double last_u = u0, last_v = v0;
    for (int i = split_high && split_low ? 0 : 1; i < 2; ++i) {
      const double u = u0 + t[i] * (u1 - u0), v = v0 + t[i] * (v1 - v0);
      add_piece(last_u, last_v, u, v);
      last_u = u;
      last_v = v;
    }
    add_piece(last_u, last_v, u1, v1);
  }
};

/// Hands out the edges of the part of a closed loop where n.x <= d; the gaps that the line leaves
/// are closed along it.
template <class Emit>
class HalfPlaneCut {
 public:
  HalfPlaneCut(const Vec2& n, double d, Emit& emit) : n_(n), d_(d), emit_(emit) {}

  void start(const Vec2& x) {
    last_ = x;
    last_s_ = n_.dot(x) - d_;
    has_exit_ = has_entry_ = false;
  }
  void go_to(const Vec2& x) {
    const double s = n_.dot(x) - d_;
    if (last_s_ <= 0 && s <= 0) {
      emit_(last_, x);
    } else if ((last_s_ <= 0) != (s <= 0)) {
      const Vec2 c = last_ + (last_s_ / (last_s_ - s)) * (x - last_);
      if (s > 0) {
        emit_(last_, c);
        exit_ = c;
        has_exit_ = true;
      } else {
        if (has_exit_) {
          emit_(exit_, c);
        } else {
          entry_ = c;
          has_entry_ = true;
        }
        emit_(c, x);
      }
    }
    last_ = x;
    last_s_ = s;
  }
  void finish() {
    if (has_entry_) emit_(exit_, entry_);
  }

 private:
  const Vec2 n_;
  const double d_;
  Emit& emit_;
  Vec2 last_ = Vec2::Zero(), exit_ = Vec2::Zero(), entry_ = Vec2::Zero();
  double last_s_ = 0;
  bool has_exit_ = false, has_entry_ = false;
};

/// Position of x in the axes of the control volume, from its centre.
inline Vec2 local(const OrientedBox<2>& cv, const Vec2& x) {
  const Vec2 r = x - cv.centre;
  return {cv.axes(0, 0) * r.x() + cv.axes(1, 0) * r.y(),
          cv.axes(0, 1) * r.x() + cv.axes(1, 1) * r.y()};
}

}  // namespace

SectionPatch::SectionPatch(const std::vector<WeightedLoop>& loops, const Box<2>& box,
                           std::shared_ptr<const DistanceTable> table)
    : table_(std::move(table)) {
  // A little larger than asked, so that no face can fall on the sides that clipping makes.
  const Vec2 more = 1e-6 * (box.upper - box.lower);
  for (const WeightedLoop& loop : loops) {
    const Polygon p = clip_to_box(loop.points, {box.lower - more, box.upper + more});
    if (p.size() < 3) continue;
    const int begin = static_cast<int>(points_.size());
    points_.insert(points_.end(), p.begin(), p.end());
    points_.push_back(p.front());
    loops_.push_back({begin, static_cast<int>(points_.size()), loop.weight});
    porous_ = porous_ || loop.weight != 1.0;
  }
}

SectionPatch::Seen SectionPatch::look(const Vec2& centre, double radius) const {
  if (table_ == nullptr) return Seen::unknown;
  const double d = table_->value(centre), need = radius + table_->error_bound();
  if (d > need) return porous_ ? Seen::unknown : Seen::fluid;
  return d < -need ? Seen::solid : Seen::unknown;
}

SolidPart<2> SectionPatch::solid_part(const OrientedBox<2>& cv) const {
  SolidPart<2> part;
  if (loops_.empty()) return part;
  const double full = 4 * cv.half.x() * cv.half.y();
  const Seen seen = look(cv.centre, cv.half.norm());
  if (seen == Seen::fluid) return part;
  if (seen == Seen::solid) {
    part.volume = full;
    part.moment = full * cv.centre;
    return part;
  }
  double volume = 0;
  Vec2 moment = Vec2::Zero();
  for (const Loop& loop : loops_) {
    Slices sum{cv.half.x(), cv.half.y()};
    Vec2 last = local(cv, points_[static_cast<std::size_t>(loop.begin)]);
    for (int i = loop.begin + 1; i < loop.end; ++i) {
      const Vec2 next = local(cv, points_[static_cast<std::size_t>(i)]);
      sum.add_edge(last.x(), last.y(), next.x(), next.y());
      last = next;
    }
    volume += loop.weight * sum.area;
    moment += loop.weight * Vec2(sum.moment_u, sum.moment_v);
  }
  part.volume = std::clamp(volume, 0.0, full);
  part.moment = cv.axes * moment + part.volume * cv.centre;
  return part;
}

double SectionPatch::solid_volume_below(const OrientedBox<2>& cv, const HalfSpace<2>& water) const {
  if (loops_.empty()) return 0;
  const Vec2 n = cv.axes.transpose() * water.normal;
  const double d = water.d - water.normal.dot(cv.centre);
  const double reach = std::abs(n.x()) * cv.half.x() + std::abs(n.y()) * cv.half.y();
  if (d >= reach) return solid_part(cv).volume;
  if (d <= -reach) return 0;
  const Seen seen = look(cv.centre, cv.half.norm());
  if (seen == Seen::fluid) return 0;

  Slices sum{cv.half.x(), cv.half.y()};
  auto emit = [&](const Vec2& p, const Vec2& q) { sum.add_edge(p.x(), p.y(), q.x(), q.y()); };
  HalfPlaneCut cut(n, d, emit);
  if (seen == Seen::solid) {
    const double a = cv.half.x(), b = cv.half.y();
    cut.start({-a, -b});
    cut.go_to({a, -b});
    cut.go_to({a, b});
    cut.go_to({-a, b});
    cut.go_to({-a, -b});
    cut.finish();
    return std::clamp(sum.area, 0.0, 4 * a * b);
  }
  double volume = 0;
  for (const Loop& loop : loops_) {
    sum.area = 0;
    cut.start(local(cv, points_[static_cast<std::size_t>(loop.begin)]));
    for (int i = loop.begin + 1; i < loop.end; ++i)
      cut.go_to(local(cv, points_[static_cast<std::size_t>(i)]));
    cut.finish();
    volume += loop.weight * sum.area;
  }
  return std::clamp(volume, 0.0, 4 * cv.half.x() * cv.half.y());
}

double SectionPatch::solid_face_fraction(const OrientedBox<2>& cv, int axis, bool high) const {
  if (loops_.empty()) return 0;
  const int along = 1 - axis;
  const double at = high ? cv.half[axis] : -cv.half[axis], b = cv.half[along];
  const Seen seen = look(cv.centre + at * cv.axes.col(axis), b);
  if (seen != Seen::unknown) return seen == Seen::solid ? 1 : 0;
  // The solid lies on the left of each edge: crossings add the face's length beyond them.
  const double sign = axis == 0 ? -1 : 1;
  double length = 0;
  for (const Loop& loop : loops_) {
    double sum = 0;
    Vec2 last = local(cv, points_[static_cast<std::size_t>(loop.begin)]);
    for (int i = loop.begin + 1; i < loop.end; ++i) {
      const Vec2 next = local(cv, points_[static_cast<std::size_t>(i)]);
      if ((last[axis] > at) != (next[axis] > at)) {
        const double t = (at - last[axis]) / (next[axis] - last[axis]);
        const double x = std::clamp(last[along] + t * (next[along] - last[along]), -b, b);
        sum += next[axis] > at ? x : -x;
      }
      last = next;
    }
    length += sign * loop.weight * sum;
  }
  return std::clamp(0.5 * length / b, 0.0, 1.0);
}

}  // namespace seaway::hull
