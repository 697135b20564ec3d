// SPDX-License-Identifier: GPL-3.0-or-later
// Certificates for tests of TLS, made on the spot.
#pragma once

#include <string>

namespace seaway::testing {

struct Pem {
  std::string certificate, key;
};

/// An authority, or (with `issuer`) a certificate of it for 127.0.0.1 and localhost.
Pem make_certificate(const std::string& common_name, const Pem* issuer = nullptr);

}  // namespace seaway::testing
