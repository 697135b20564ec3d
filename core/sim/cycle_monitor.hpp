// Mean, first harmonic and phase of several signals over each whole period: what the convergence rules and
// the amplitudes of a stage are made of. Samples may come at any times; a cycle's integrals are exact for the
// straight lines between them.
#pragma once

#include <vector>

namespace seaway::sim {

class CycleMonitor {
 public:
  struct Signal {
    double mean = 0, amplitude = 0, phase = 0;  ///< phase of the maximum in the cycle [rad]
  };
  using Cycle = std::vector<Signal>;

  CycleMonitor() = default;
  CycleMonitor(double start, double period, std::size_t n_signals);

  /// Before: t grows from call to call. The first call at or after `start` begins.
  void add(double t, const std::vector<double>& values);

  const std::vector<Cycle>& cycles() const { return cycles_; }
  std::size_t count() const { return cycles_.size(); }
  double period() const { return period_; }
  double start() const { return start_; }

  /// Largest relative change of the amplitude of `signals` from the last cycle but `back` to the last;
  /// infinite while there are too few cycles.
  double amplitude_change(const std::vector<std::size_t>& signals, std::size_t back) const;
  /// Largest change of amplitude, mean (both relative to the amplitude) and period (phase drift) per
  /// `back` cycles.
  double motion_change(const std::vector<std::size_t>& signals, std::size_t back) const;
  /// Whether the motions repeat: at least `least` cycles, two or more, and less change than `tolerance` over the last two.
  bool repeats(const std::vector<std::size_t>& signals, double tolerance, double least) const;
  /// Mean over the last `n` cycles.
  Signal average(std::size_t signal, std::size_t n) const;
  /// Period of a signal: the monitor's, corrected by the phase drift over the last `n` cycles.
  double signal_period(std::size_t signal, std::size_t n) const;

  /// Everything, to the bit, for checkpoints.
  std::vector<double> save() const;
  static CycleMonitor load(const std::vector<double>& state);

 private:
  void integrate(double t0, const std::vector<double>& v0, double t1, const std::vector<double>& v1);
  void close_cycle();

  double start_ = 0, period_ = 0;
  bool begun_ = false;
  double last_t_ = 0;
  std::vector<double> last_v_, sum_, cos_, sin_;
  std::vector<Cycle> cycles_;
};

}  // namespace seaway::sim
