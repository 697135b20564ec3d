#include "core/hull/compartment_spec.hpp"

#include <fmt/format.h>

namespace seaway::hull {
namespace {

constexpr const char* axis_names = "xyz";

template <int Dim>
void check_box(const std::string& where, const char* what, const std::string& name, const Box<Dim>& box,
               double thinnest, double largest, std::vector<ShapeProblem>& problems) {
  for (int a = 0; a < Dim; ++a) {
    const double low = box.lower[a], high = box.upper[a];
    if (low > -largest && high < largest && high - low > thinnest) continue;
    problems.push_back({fmt::format("{}.{}", where, axis_names[3 - Dim + a]),
                        fmt::format("{} '{}' reaches from {} to {} m", what, name, low, high),
                        "give two finite numbers, the lower one first"});
  }
}

}  // namespace

template <int Dim>
std::string text(const Box<Dim>& box) {
  const auto point = [](const Vec<Dim>& x) {
    std::string out;
    for (int a = 0; a < Dim; ++a) out += fmt::format("{}{}", a == 0 ? "(" : ", ", x[a]);
    return out + ")";
  };
  return point(box.lower) + " to " + point(box.upper);
}

template <int Dim>
std::vector<ShapeProblem> find_number_problems(const std::string& where, const CompartmentSpecOf<Dim>& c,
                                               double thinnest, double largest) {
  std::vector<ShapeProblem> problems;
  check_box<Dim>(where, "compartment", c.name, c.box, thinnest, largest, problems);
  if (!(c.wall_thickness >= 0 && c.wall_thickness < largest))
    problems.push_back({where + ".wall_thickness", fmt::format("{} m; it must be 0 or more", c.wall_thickness),
                        "give the thickness of the shell in metres"});
  if (!(c.permeability > 0 && c.permeability <= 1))
    problems.push_back({where + ".permeability", fmt::format("{}; allowed: above 0 and at most 1", c.permeability),
                        "leave the compartment out if no water can enter it"});
  for (std::size_t k = 0; k < c.openings.size(); ++k)
    check_box<Dim>(fmt::format("{}.openings[{}]", where, k), "opening", c.openings[k].name, c.openings[k].box,
                   thinnest, largest, problems);
  return problems;
}

template std::string text<2>(const Box<2>&);
template std::string text<3>(const Box<3>&);
template std::vector<ShapeProblem> find_number_problems<2>(const std::string&, const CompartmentSpecOf<2>&, double,
                                                           double);
template std::vector<ShapeProblem> find_number_problems<3>(const std::string&, const CompartmentSpecOf<3>&, double,
                                                           double);

}  // namespace seaway::hull
