// SPDX-License-Identifier: GPL-3.0-or-later
// Page tokens: only those that the service makes are taken, for the filter they were made for. The first byte is a filter.
#include "server/convert/input_error.hpp"
#include "server/rpc/messages.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace seaway;
  if (size == 0) return 0;
  store::ListQuery query;
  for (int state = 1; state <= 7; ++state)
    if ((data[0] >> state & 1) != 0) query.states.push_back(static_cast<store::State>(state));
  if ((data[0] & 1) != 0) query.labels = {{"ship", "a"}};
  const std::string token(fuzz::view(data + 1, size - 1));
  try {
    const std::int64_t id = rpc::parse_page_token(token, query);
    fuzz::require(token.empty() ? id == 0 : rpc::make_page_token(id, query) == token, "a token that was not made here");
  } catch (const convert::InputError&) {
  }
  const std::int64_t id = 1 + static_cast<std::int64_t>(std::hash<std::string>{}(token) >> 2);
  fuzz::require(rpc::parse_page_token(rpc::make_page_token(id, query), query) == id, "a token is not taken back");
  try {
    const std::int64_t sweep = rpc::parse_sweep_token(token);
    fuzz::require(token.empty() ? sweep == 0 : rpc::make_sweep_token(sweep) == token, "a token of sweeps that was not made here");
  } catch (const convert::InputError&) {
  }
  return 0;
}
