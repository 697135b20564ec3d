// SPDX-License-Identifier: GPL-3.0-or-later
// Certificates for tests of TLS, made on the spot.
#pragma once

#include <string>

namespace seaway::testing {

struct Pem {
  std::string certificate, key;
};

/// An authority, or (with `issuer`) a certificate of it for 127.0.0.1 and localhost. `valid_s`: from an hour ago until so long
/// from now; negative: it has expired.
Pem make_certificate(const std::string& common_name, const Pem* issuer = nullptr, long valid_s = 86400);

}  // namespace seaway::testing
