// Common part of the regular waves of this folder: phase, heading and the shared series. Internal.
#pragma once

#include "core/waves/mode_series.hpp"
#include "core/waves/wave_field.hpp"

namespace seaway::waves {

class RegularWave : public WaveField {
 public:
  struct Shape {
    double length, period, celerity, crest, trough, current, transport;
  };
  RegularWave(const RegularWaveSpec& spec, const Shape& shape, ModeSeries series);

  double elevation(double x, double y, double t) const override;
  Vec3 velocity(const Vec3& x, double t) const override;
  void column_velocity(double x, double y, double t, std::span<const double> z,
                       std::span<Vec3> velocity) const override;

  double length() const override { return shape_.length; }
  double period() const override { return shape_.period; }
  double celerity() const override { return shape_.celerity; }
  double depth() const override { return spec_.depth; }
  double height() const override { return spec_.height; }
  double heading() const override { return spec_.heading; }
  double gravity() const override { return spec_.gravity; }
  double rho() const override { return spec_.rho; }
  double crest() const override { return shape_.crest; }
  double trough() const override { return shape_.trough; }
  double max_slope() const override { return series_.max_slope(); }
  double mean_eulerian_velocity() const override { return shape_.current; }
  double mean_transport() const override { return shape_.transport; }

 protected:
  double theta(double x, double y, double t) const;
  const ModeSeries& series() const { return series_; }

 private:
  RegularWaveSpec spec_;
  Shape shape_;
  ModeSeries series_;
  double k_, omega_, cos_heading_, sin_heading_;
};

/// Regular waves whose pressure follows from their velocity by Bernoulli's equation in the wave's frame.
class BernoulliWave final : public RegularWave {
 public:
  /// `bernoulli`: R less g d, heights from the mean level [m2/s2].
  BernoulliWave(const RegularWaveSpec& spec, const Shape& shape, ModeSeries series, double bernoulli);
  double pressure(const Vec3& x, double t) const override;

 private:
  double bernoulli_;
};

}  // namespace seaway::waves
