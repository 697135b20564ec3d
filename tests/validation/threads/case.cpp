// [threads] The number of threads changes no bit; see README.md beside this file.
#include <cstring>

#include "tests/validation/cases.hpp"
#include "tests/validation/support/tank_run.hpp"

namespace seaway::validation {
namespace {

void append(std::vector<double>& to, const double* from, std::size_t n) {
  to.insert(to.end(), from, from + n);
}

/// All leaves' fields and the hull's state after 15 steps on a mesh, mapping, and 15 on a finer
/// one.
std::vector<double> bits_of_run(int threads) {
  sim::Case c = example_case();
  c.body.release = sim::Body::Release::at_start;
  c.body.angles = {5 * degree, 0, 0};
  auto run = start(c, threads);
  for (int i = 0; i < 15; ++i) step(*run);
  run = map_to_stage(*run, c.stages[1], threads).run;
  for (int i = 0; i < 15; ++i) step(*run);

  std::vector<double> bits;
  for (const int b : run->forest().leaves()) {
    append(bits, run->state().vof.block(b), mesh::BlockShape<2>::cells);
    append(bits, run->state().p.block(b), mesh::BlockShape<2>::cells);
    for (int axis = 0; axis < 2; ++axis) {
      append(bits, run->state().u.block(axis, b), mesh::BlockShape<2>::faces);
      append(bits, run->state().w.block(axis, b), mesh::BlockShape<2>::faces);
    }
  }
  const auto x = displacement(*run);
  append(bits, x.data(), 3);
  append(bits, run->body().twist.data(), 3);
  append(bits, run->load().data(), 3);
  const sim::WaterBalance water = run->water();
  for (const double v : {water.visible, water.exchanged, water.reservoir}) bits.push_back(v);
  return bits;
}

}  // namespace

void run_threads(const Context&, Results& results) {
  const std::vector<double> one = bits_of_run(1);
  bool same = true;
  for (const int threads : {2, 4}) {
    const std::vector<double> bits = bits_of_run(threads);
    same = same && bits.size() == one.size() &&
           std::memcmp(bits.data(), one.data(), bits.size() * sizeof(double)) == 0;
  }
  results.expect_above("identical", same, "1", 1);  // to the bit, or not at all
  results.report("values", static_cast<double>(one.size()), "1");
}

}  // namespace seaway::validation
