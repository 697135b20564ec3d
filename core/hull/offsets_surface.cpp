// Closed surface of a ship out of its table of half-breadths (offsets_surface in
// surface_shapes.hpp).
#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/hull/surface_shapes.hpp"

namespace seaway::hull {

namespace {

struct Point {
  double y, z;
};
using Curve = std::vector<Point>;  // from below upwards

/// A station's half section: `upper` alone, or with a gap also what lies below it.
struct Station {
  double x = 0;
  Curve lower, upper;
  bool has_gap() const { return !lower.empty(); }
};

/// Where the straight line through the last two points of a curve meets the centre plane; kept
/// between the last point and `limit`.
double centre_crossing(const Point& inner, const Point& last, double limit) {
  const double dy = last.y - inner.y;
  const double z = dy < 0 ? last.z - last.y * (last.z - inner.z) / dy : limit;
  return std::clamp(z, std::min(last.z, limit), std::max(last.z, limit));
}

Station read_station(const OffsetsTable& table, const OffsetsTable::Station& row) {
  struct Run {
    Curve points;
    std::size_t first, last;
  };
  std::vector<Run> runs;
  for (std::size_t k = 0; k < table.waterlines.size(); ++k) {
    const auto& y = row.half_breadths[k];
    if (!y) continue;
    if (runs.empty() || runs.back().last + 1 != k) runs.push_back({{}, k, k});
    runs.back().points.push_back({*y, table.waterlines[k]});
    runs.back().last = k;
  }
  SEAWAY_CHECK(!runs.empty(), "station x = {} has no half-breadths; remove it or fill it in",
               row.x);
  SEAWAY_CHECK(runs.size() <= 2, "station x = {} has {} gaps; at most one is understood", row.x,
               runs.size() - 1);
  Curve& bottom = runs.front().points;
  if (row.keel_z && *row.keel_z < bottom.front().z) {
    bottom.insert(bottom.begin(), {0.0, *row.keel_z});
  } else if (bottom.front().y > 0) {
    bottom.insert(bottom.begin(), {0.0, bottom.front().z});
  }
  Curve& top = runs.back().points;
  if (row.deck_z && row.deck_y && *row.deck_z > top.back().z)
    top.push_back({*row.deck_y, *row.deck_z});
  Station s;
  s.x = row.x;
  if (runs.size() == 2) {
    SEAWAY_CHECK(bottom.size() >= 3 && top.size() >= 2,
                 "station x = {}: too few waterlines below or above its gap", row.x);
    const std::size_t below = runs[0].last + 1, above = runs[1].first - 1;
    const double z_low =
        centre_crossing(bottom[bottom.size() - 2], bottom.back(), table.waterlines[below]);
    const double z_high = centre_crossing(top[1], top[0], table.waterlines[above]);
    bottom.push_back({0.0, z_low});
    top.insert(top.begin(), {0.0, std::max(z_high, z_low + 0.25 * (top[0].z - z_low))});
    s.lower = bottom;
  }
  s.upper = top;
  for (const Curve* c : {&s.lower, &s.upper})
    SEAWAY_CHECK(c->empty() || c->size() >= 2,
                 "station x = {} has {} points; at least 2 are needed", row.x, c->size());
  return s;
}

/// n + 1 points at equal distances along the curve between heights that it has.
Curve resampled(const Curve& c, int n) {
  std::vector<double> s{0.0};
  for (std::size_t i = 1; i < c.size(); ++i)
    s.push_back(s.back() + std::hypot(c[i].y - c[i - 1].y, c[i].z - c[i - 1].z));
  Curve out{c.front()};
  std::size_t at = 1;
  for (int i = 1; i < n; ++i) {
    const double want = s.back() * i / n;
    while (s[at] < want) ++at;
    const double t = (want - s[at - 1]) / (s[at] - s[at - 1]);
    out.push_back(
        {c[at - 1].y + t * (c[at].y - c[at - 1].y), c[at - 1].z + t * (c[at].z - c[at - 1].z)});
  }
  out.push_back(c.back());
  return out;
}

/// The curve cut in two at height z.
std::pair<Curve, Curve> split_at(const Curve& c, double z) {
  std::pair<Curve, Curve> out;
  for (std::size_t i = 0; i < c.size(); ++i) {
    if (i > 0 && c[i - 1].z < z && c[i].z >= z) {
      const double t = (z - c[i - 1].z) / (c[i].z - c[i - 1].z);
      const Point p{c[i - 1].y + t * (c[i].y - c[i - 1].y), z};
      out.first.push_back(p);
      if (t < 1) out.second.push_back(p);
    }
    (c[i].z < z ? out.first : out.second).push_back(c[i]);
  }
  return out;
}

double girth(const Curve& c) {
  double s = 0;
  for (std::size_t i = 1; i < c.size(); ++i)
    s += std::hypot(c[i].y - c[i - 1].y, c[i].z - c[i - 1].z);
  return s;
}

/// Slopes of a monotone piecewise cubic, ends one-sided; inside, the weighted harmonic mean of both
/// secants.
std::vector<double> monotone_slopes(const std::vector<double>& x, const std::vector<double>& f) {
  const std::size_t n = x.size();
  std::vector<double> d(n, 0.0);
  const auto secant = [&](std::size_t i) { return (f[i + 1] - f[i]) / (x[i + 1] - x[i]); };
  if (n < 2) return d;
  d[0] = secant(0);
  d[n - 1] = secant(n - 2);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double a = secant(i - 1), b = secant(i);
    if (a * b <= 0) continue;
    const double h0 = x[i] - x[i - 1], h1 = x[i + 1] - x[i];
    const double w0 = 2 * h1 + h0, w1 = h1 + 2 * h0;
    d[i] = (w0 + w1) / (w0 / a + w1 / b);
  }
  return d;
}

double cubic(double t, double h, double f0, double f1, double d0, double d1) {
  const double t2 = t * t, t3 = t2 * t;
  return (2 * t3 - 3 * t2 + 1) * f0 + (t3 - 2 * t2 + t) * h * d0 + (3 * t2 - 2 * t3) * f1 +
         (t3 - t2) * h * d1;
}

/// One sheet of the half hull: rows of points with the same number of columns.
struct Sheet {
  std::vector<double> x;        ///< of the stations
  std::vector<Curve> sections;  ///< each with the same number of points
};

struct Column {
  std::vector<Vec3> points;
};

/// Columns of the sheet from one station to the next, both included.
std::vector<Column> columns_between(const Sheet& sheet, std::size_t i, int steps,
                                    const std::vector<std::vector<double>>& slope_y,
                                    const std::vector<std::vector<double>>& slope_z) {
  const double x0 = sheet.x[i], x1 = sheet.x[i + 1], h = x1 - x0;
  const Curve &a = sheet.sections[i], &b = sheet.sections[i + 1];
  const auto build = [&](bool smooth) {
    std::vector<Column> columns(static_cast<std::size_t>(steps) + 1);
    for (int k = 0; k <= steps; ++k) {
      const double t = static_cast<double>(k) / steps;
      for (std::size_t j = 0; j < a.size(); ++j) {
        double y = (1 - t) * a[j].y + t * b[j].y, z = (1 - t) * a[j].z + t * b[j].z;
        if (smooth && k > 0 && k < steps) {
          y = cubic(t, h, a[j].y, b[j].y, slope_y[j][i], slope_y[j][i + 1]);
          z = cubic(t, h, a[j].z, b[j].z, slope_z[j][i], slope_z[j][i + 1]);
        }
        columns[static_cast<std::size_t>(k)].points.emplace_back(k == steps ? x1 : x0 + t * h, y,
                                                                 z);
      }
    }
    return columns;
  };
  std::vector<Column> columns = build(true);
  for (const Column& c : columns)  // sections stay single-valued in z, so that none crosses itself
    for (std::size_t j = 1; j < c.points.size(); ++j)
      if (c.points[j].z() < c.points[j - 1].z()) return build(false);
  return columns;
}

class OffsetsMesher {
 public:
  OffsetsMesher(const OffsetsTable& table, const OffsetsHullSpec& spec) : spec_(spec) {
    SEAWAY_CHECK(std::isfinite(spec.scale) && spec.scale > 0, "scale is {}; it must be positive",
                 spec.scale);
    SEAWAY_CHECK(std::isfinite(spec.origin) && std::isfinite(spec.extend_to),
                 "origin {} and extend_to {} must be finite numbers", spec.origin, spec.extend_to);
    SEAWAY_CHECK(spec.n_girth >= 8 && spec.n_girth <= 2000,
                 "{} facets along the girth; allowed: 8 to 2000", spec.n_girth);
    SEAWAY_CHECK(table.stations.size() >= 2, "{} stations; a hull needs at least 2",
                 table.stations.size());
    for (const auto& row : table.stations) stations_.push_back(read_station(table, row));
    const double length = stations_.back().x - stations_.front().x;
    step_ = spec.max_step > 0 ? spec.max_step : 0.01 * length;
    check_gaps();
    double widest = 0;
    for (const Station& s : stations_)
      for (const Point& p : s.upper) widest = std::max(widest, p.y);
    least_y_ = 1e-5 * widest;
  }

  Surface run() {
    make_sheets();
    if (lower_.x.empty()) {
      mesh_sheet(upper_, true);
    } else {
      mesh_sheet(lower_, false);
      mesh_sheet(upper_, true);
      mesh_web();
      mesh_nose();
    }
    cap(0, false);
    cap(stations_.size() - 1, true);
    return transformed(out_.take(), 1 / spec_.scale, Eigen::Matrix3d::Identity(),
                       Vec3(-spec_.origin / spec_.scale, 0, 0));
  }

 private:
  void check_gaps() {
    first_gap_ = last_gap_ = stations_.size();
    for (std::size_t i = 0; i < stations_.size(); ++i) {
      if (!stations_[i].has_gap()) continue;
      SEAWAY_CHECK(first_gap_ == stations_.size() || last_gap_ + 1 == i,
                   "stations x = {} and x = {} have gaps, but not those between them; only one "
                   "notch is understood",
                   stations_[last_gap_].x, stations_[i].x);
      if (first_gap_ == stations_.size()) first_gap_ = i;
      last_gap_ = i;
    }
    SEAWAY_CHECK(first_gap_ == stations_.size() || first_gap_ >= 2,
                 "station x = {} has a gap; the two at the aft end may not",
                 stations_[first_gap_].x);
  }

  /// Rows at equal shares of the girth; with a notch the row that meets it divides both sheets.
  void make_sheets() {
    if (first_gap_ == stations_.size()) {
      for (const Station& s : stations_) add(upper_, s.x, resampled(s.upper, spec_.n_girth));
      return;
    }
    const Station& gap = stations_[first_gap_];
    const double keel = gap.lower.front().z, deck = gap.upper.back().z;
    const double share = (0.5 * (gap.lower.back().z + gap.upper.front().z) - keel) / (deck - keel);
    std::vector<std::pair<Curve, Curve>> parts;
    double low = 0, all = 0;
    for (std::size_t i = 0; i < stations_.size(); ++i) {
      const Station& s = stations_[i];
      if (i < first_gap_) {
        const double bottom = s.upper.front().z;
        parts.push_back(split_at(s.upper, bottom + share * (s.upper.back().z - bottom)));
      } else {
        parts.emplace_back(s.lower, s.upper);
      }
      if (parts.back().first.empty()) continue;
      low += girth(parts.back().first);
      all += girth(parts.back().first) + girth(parts.back().second);
    }
    const int n_low =
        std::clamp(static_cast<int>(std::lround(spec_.n_girth * low / all)), 4, spec_.n_girth - 4);
    for (std::size_t i = 0; i < stations_.size(); ++i) {
      if (i <= last_gap_) add(lower_, stations_[i].x, resampled(parts[i].first, n_low));
      add(upper_, stations_[i].x, resampled(parts[i].second, spec_.n_girth - n_low));
    }
  }

  void add(Sheet& sheet, double x, Curve c) {
    // Only the keel and the sides of a notch lie in the centre plane.
    for (std::size_t j = 1; j + 1 < c.size(); ++j) c[j].y = std::max(c[j].y, least_y_);
    if (&sheet == &upper_ && spec_.extend_to != 0) {
      const double z = spec_.extend_to * spec_.scale;
      SEAWAY_CHECK(z > c.back().z,
                   "extend_to is {} m; the deck at x = {} is at {} m: it must lie "
                   "above all of them",
                   spec_.extend_to, x, c.back().z / spec_.scale);
      const Point edge = c.back();
      const int n = std::max(1, spec_.n_girth / 6);
      for (int i = 1; i <= n; ++i) c.push_back({edge.y, edge.z + (z - edge.z) * i / n});
    }
    if (&sheet == &upper_) c.back().y = std::max(c.back().y, least_y_);
    sheet.x.push_back(x);
    sheet.sections.push_back(std::move(c));
  }

  int steps(double x0, double x1) const {
    return std::max(1, static_cast<int>(std::ceil((x1 - x0) / step_ - 1e-9)));
  }

  /// All columns of a sheet; those at the stations appear twice, at the end of one span and at the
  /// beginning of the next.
  std::vector<std::vector<Column>> spans(const Sheet& sheet) const {
    const std::size_t n_rows = sheet.sections.front().size();
    std::vector<std::vector<double>> slope_y, slope_z;
    for (std::size_t j = 0; j < n_rows; ++j) {
      std::vector<double> y, z;
      for (const Curve& c : sheet.sections) {
        y.push_back(c[j].y);
        z.push_back(c[j].z);
      }
      slope_y.push_back(monotone_slopes(sheet.x, y));
      slope_z.push_back(monotone_slopes(sheet.x, z));
    }
    std::vector<std::vector<Column>> out;
    for (std::size_t i = 0; i + 1 < sheet.x.size(); ++i)
      out.push_back(columns_between(sheet, i, steps(sheet.x[i], sheet.x[i + 1]), slope_y, slope_z));
    return out;
  }

  void mesh_sheet(const Sheet& sheet, bool with_deck) {
    for (const auto& span : spans(sheet))
      for (std::size_t k = 0; k + 1 < span.size(); ++k) {
        const auto &a = span[k].points, &b = span[k + 1].points;
        for (std::size_t j = 0; j + 1 < a.size(); ++j)
          out_.mirrored_quad(a[j], a[j + 1], b[j + 1], b[j]);
        if (!with_deck) continue;
        for (int strip = 0; strip < n_across; ++strip)
          out_.quad(across(a.back(), strip), across(b.back(), strip), across(b.back(), strip + 1),
                    across(a.back(), strip + 1));
      }
  }

  /// Point `part` of n_across from starboard to port.
  static Vec3 across(const Vec3& port, int part) {
    const double s = 2.0 * part / n_across - 1;
    return {port.x(), part == n_across ? port.y() : (part == 0 ? -port.y() : s * port.y()),
            port.z()};
  }

  /// Between the two sheets where the notch begins.
  void mesh_web() {
    const std::size_t i = first_gap_ - 1;
    const auto low = spans(lower_)[i], high = spans(upper_)[i];
    for (std::size_t k = 0; k + 1 < low.size(); ++k)
      out_.mirrored_quad(low[k].points.back(), high[k].points.front(), high[k + 1].points.front(),
                         low[k + 1].points.back());
  }

  /// In front of the last station of the lower sheet: the square of the half-breadth falls to 0 as
  /// a parabola through the last three stations says, at the latest at the next station.
  void mesh_nose() {
    const std::size_t n = lower_.x.size();
    const Curve &c = lower_.sections[n - 1], &b = lower_.sections[n - 2],
                &a = lower_.sections[n - 3];
    const double x = lower_.x[n - 1], hb = x - lower_.x[n - 2], ha = x - lower_.x[n - 3];
    const double limit = last_gap_ + 1 < stations_.size() ? stations_[last_gap_ + 1].x - x : hb;
    constexpr int n_nose = 6;
    std::vector<double> reach;
    for (std::size_t j = 0; j < c.size(); ++j) {
      const double fc = c[j].y * c[j].y, sb = (fc - b[j].y * b[j].y) / hb,
                   sa = (fc - a[j].y * a[j].y) / ha;
      const double curvature = (sb - sa) / (ha - hb), slope = sb + curvature * hb;  // f'' / 2, f'
      const double root = slope * slope - 4 * curvature * fc;
      double r = limit;  // f + slope r + curvature r^2 = 0
      if (root >= 0 && slope < 0) r = 2 * fc / (-slope + std::sqrt(root));
      if (j == 0 || j + 1 == c.size()) r = 0;
      reach.push_back(std::clamp(r, 0.0, limit));
    }
    const auto at = [&](int k, std::size_t j) {
      const double f = static_cast<double>(k) / n_nose, along = 1 - (1 - f) * (1 - f);
      return Vec3(x + along * reach[j], k == n_nose ? 0.0 : (1 - f) * c[j].y, c[j].z);
    };
    for (int k = 0; k < n_nose; ++k)
      for (std::size_t j = 0; j + 1 < c.size(); ++j)
        out_.mirrored_quad(at(k, j), at(k, j + 1), at(k + 1, j + 1), at(k + 1, j));
  }

  /// Flat end at a station, in strips between the heights of the rows.
  void cap(std::size_t station, bool forward) {
    for (const Sheet* sheet : {&lower_, &upper_}) {
      if (station >= sheet->x.size() || (sheet == &lower_ && station == last_gap_)) continue;
      const Curve& c = sheet->sections[station];
      const double x = sheet->x[station];
      std::vector<Vec3> below;
      for (std::size_t j = 0; j < c.size();) {
        std::size_t last = j;  // rows j to last lie at one height: a flat bottom or a step
        while (last + 1 < c.size() && c[last + 1].z == c[j].z) ++last;
        const bool widens = c[last].y >= c[j].y;
        std::vector<Vec3> inner, outer;
        for (int k = 0; k <= n_across; ++k) {
          const Point& p = widens ? c[j] : c[last];
          inner.push_back(across({x, p.y, p.z}, k));
          if (p.y == 0) break;
        }
        outer = inner;
        for (std::size_t i = j + 1; i <= last; ++i) {
          const Point& p = widens ? c[i] : c[last - (i - j)];
          outer.insert(outer.begin(), Vec3(x, -p.y, p.z));
          outer.push_back(Vec3(x, p.y, p.z));
        }
        if (!below.empty()) strip(below, widens ? inner : outer, forward);
        below = widens ? outer : inner;
        j = last + 1;
      }
    }
  }

  /// Triangles between two level rows of points, both from starboard to port.
  void strip(const std::vector<Vec3>& low, const std::vector<Vec3>& high, bool forward) {
    std::size_t i = 0, j = 0;
    const auto share = [](const std::vector<Vec3>& row, std::size_t k) {
      const double width = row.back().y() - row.front().y();
      return width > 0 ? (row[k].y() - row.front().y()) / width : 0.5;
    };
    while (i + 1 < low.size() || j + 1 < high.size()) {
      const bool on_low =
          j + 1 == high.size() || (i + 1 < low.size() && share(low, i + 1) <= share(high, j + 1));
      const Vec3 &a = low[i], &b = high[j], &c = on_low ? low[i + 1] : high[j + 1];
      if (forward)
        out_.triangle(a, c, b);
      else
        out_.triangle(a, b, c);
      (on_low ? i : j) += 1;
    }
  }

  static constexpr int n_across = 6;
  const OffsetsHullSpec& spec_;
  std::vector<Station> stations_;
  std::size_t first_gap_ = 0, last_gap_ = 0;
  double step_ = 0, least_y_ = 0;
  Sheet lower_, upper_;
  SurfaceBuilder out_;
};

}  // namespace

Surface offsets_surface(const OffsetsTable& table, const OffsetsHullSpec& spec) {
  Surface s = OffsetsMesher(table, spec).run();
  const auto problems = find_surface_problems(s);
  if (!problems.empty())
    fail(ErrorCode::invalid_argument,
         "the hull made from the offsets is not closed: {}; check the "
         "table near there",
         problems[0].message);
  return s;
}

}  // namespace seaway::hull
