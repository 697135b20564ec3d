#include "core/sim/cycle_monitor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/constants.hpp"

namespace seaway::sim {

CycleMonitor::CycleMonitor(double start, double period, std::size_t n_signals)
    : start_(start), period_(period), last_v_(n_signals), sum_(n_signals), cos_(n_signals), sin_(n_signals) {}

void CycleMonitor::integrate(double t0, const std::vector<double>& v0, double t1, const std::vector<double>& v1) {
  // Simpson with the line's middle value: the harmonic weights are smooth over a step.
  const double omega = 2 * pi / period_, tm = 0.5 * (t0 + t1), w = (t1 - t0) / 6;
  const double c0 = std::cos(omega * (t0 - start_)), cm = std::cos(omega * (tm - start_)), c1 = std::cos(omega * (t1 - start_));
  const double s0 = std::sin(omega * (t0 - start_)), sm = std::sin(omega * (tm - start_)), s1 = std::sin(omega * (t1 - start_));
  for (std::size_t k = 0; k < sum_.size(); ++k) {
    const double vm = 0.5 * (v0[k] + v1[k]);
    sum_[k] += w * (v0[k] + 4 * vm + v1[k]);
    cos_[k] += w * (v0[k] * c0 + 4 * vm * cm + v1[k] * c1);
    sin_[k] += w * (v0[k] * s0 + 4 * vm * sm + v1[k] * s1);
  }
}

void CycleMonitor::close_cycle() {
  Cycle cycle(sum_.size());
  for (std::size_t k = 0; k < sum_.size(); ++k) {
    const double a = 2 * cos_[k] / period_, b = 2 * sin_[k] / period_;
    cycle[k] = {sum_[k] / period_, std::hypot(a, b), std::atan2(b, a)};
  }
  cycles_.push_back(std::move(cycle));
  std::fill(sum_.begin(), sum_.end(), 0.0);
  std::fill(cos_.begin(), cos_.end(), 0.0);
  std::fill(sin_.begin(), sin_.end(), 0.0);
}

void CycleMonitor::add(double t, const std::vector<double>& values) {
  if (period_ <= 0) return;
  if (!begun_) {
    if (t < start_ - 1e-9 * period_) return;
    start_ = t;
    begun_ = true;
    last_t_ = t;
    last_v_ = values;
    return;
  }
  for (;;) {
    const double end = start_ + static_cast<double>(cycles_.size() + 1) * period_;
    if (t < end - 1e-9 * period_) break;
    const double part = t > last_t_ ? (end - last_t_) / (t - last_t_) : 1.0;
    std::vector<double> at_end(values.size());
    for (std::size_t k = 0; k < values.size(); ++k) at_end[k] = last_v_[k] + part * (values[k] - last_v_[k]);
    integrate(last_t_, last_v_, end, at_end);
    close_cycle();
    last_t_ = end;
    last_v_ = at_end;
  }
  if (t > last_t_) {
    integrate(last_t_, last_v_, t, values);
    last_t_ = t;
    last_v_ = values;
  }
}

double CycleMonitor::amplitude_change(const std::vector<std::size_t>& signals, std::size_t back) const {
  if (cycles_.size() <= back) return std::numeric_limits<double>::infinity();
  const Cycle &now = cycles_.back(), &then = cycles_[cycles_.size() - 1 - back];
  double largest = 0;
  for (const std::size_t k : signals) {
    const double scale = std::max(now[k].amplitude, then[k].amplitude);
    if (scale > 0) largest = std::max(largest, std::abs(now[k].amplitude - then[k].amplitude) / scale);
  }
  return largest;
}

double CycleMonitor::motion_change(const std::vector<std::size_t>& signals, std::size_t back) const {
  double largest = amplitude_change(signals, back);
  if (cycles_.size() <= back) return largest;
  const Cycle &now = cycles_.back(), &then = cycles_[cycles_.size() - 1 - back];
  for (const std::size_t k : signals) {
    const double scale = std::max(now[k].amplitude, then[k].amplitude);
    if (!(scale > 0)) continue;
    largest = std::max(largest, std::abs(now[k].mean - then[k].mean) / scale);
    const double drift = std::remainder(now[k].phase - then[k].phase, 2 * pi);
    largest = std::max(largest, std::abs(drift) / (2 * pi * static_cast<double>(back)));
  }
  return largest;
}

bool CycleMonitor::repeats(const std::vector<std::size_t>& signals, double tolerance, double least) const {
  return static_cast<double>(cycles_.size()) >= std::max(least, 2.0) && motion_change(signals, 2) < tolerance;
}

CycleMonitor::Signal CycleMonitor::average(std::size_t signal, std::size_t n) const {
  Signal out;
  const std::size_t count = std::min(n, cycles_.size());
  for (std::size_t c = cycles_.size() - count; c < cycles_.size(); ++c) {
    out.mean += cycles_[c][signal].mean / static_cast<double>(count);
    out.amplitude += cycles_[c][signal].amplitude / static_cast<double>(count);
    out.phase = cycles_[c][signal].phase;
  }
  return out;
}

double CycleMonitor::signal_period(std::size_t signal, std::size_t n) const {
  const std::size_t count = std::min(n, cycles_.size());
  if (count < 2) return period_;
  // The phase of the maximum moves on by 2 pi (T' - T) / T a cycle.
  double drift = 0;
  for (std::size_t c = cycles_.size() - count + 1; c < cycles_.size(); ++c)
    drift += std::remainder(cycles_[c][signal].phase - cycles_[c - 1][signal].phase, 2 * pi);
  return period_ * (1 + drift / (2 * pi * static_cast<double>(count - 1)));
}

std::vector<double> CycleMonitor::save() const {
  std::vector<double> out{start_, period_, begun_ ? 1.0 : 0.0, last_t_, static_cast<double>(sum_.size()),
                          static_cast<double>(cycles_.size())};
  for (const auto* v : {&last_v_, &sum_, &cos_, &sin_}) out.insert(out.end(), v->begin(), v->end());
  for (const Cycle& cycle : cycles_)
    for (const Signal& s : cycle) out.insert(out.end(), {s.mean, s.amplitude, s.phase});
  return out;
}

CycleMonitor CycleMonitor::load(const std::vector<double>& state) {
  std::size_t at = 0;
  const auto next = [&] { return state.at(at++); };
  CycleMonitor m;
  m.start_ = next();
  m.period_ = next();
  m.begun_ = next() != 0;
  m.last_t_ = next();
  const auto signals = static_cast<std::size_t>(next()), cycles = static_cast<std::size_t>(next());
  for (auto* v : {&m.last_v_, &m.sum_, &m.cos_, &m.sin_}) {
    v->resize(signals);
    for (double& x : *v) x = next();
  }
  for (std::size_t c = 0; c < cycles; ++c) {
    Cycle cycle(signals);
    for (Signal& s : cycle) {
      s.mean = next();
      s.amplitude = next();
      s.phase = next();
    }
    m.cycles_.push_back(std::move(cycle));
  }
  return m;
}

}  // namespace seaway::sim
