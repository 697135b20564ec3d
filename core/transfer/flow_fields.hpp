// The fields of a flow that are carried from stage to stage.
#pragma once

#include <vector>

#include "core/field/field.hpp"

namespace seaway::transfer {

using field::CellField;
using field::FaceField;
using mesh::Forest;

template <int Dim>
struct FlowFields {
  CellField<double, Dim> vof;                 ///< water volume fraction, 0..1
  CellField<double, Dim> p;                   ///< pressure [Pa]
  FaceField<double, Dim> u;                   ///< velocity of the fluid [m/s]
  FaceField<double, Dim> w;                   ///< velocity of the mixture over full faces, solenoidal [m/s]
  std::vector<CellField<double, Dim>> extra;  ///< any further cell fields (tke, epsilon)
};

template <int Dim>
bool is_set(const CellField<double, Dim>& f) {
  return !f.data().empty();
}
template <int Dim>
bool is_set(const FaceField<double, Dim>& f) {
  return !f.data(0).empty();
}

}  // namespace seaway::transfer
