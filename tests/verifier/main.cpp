// SPDX-License-Identifier: Apache-2.0
// verify_certificates MODEL RESULT.json: confirms the certificates of a result file of `hcsp-solve -o` by
// means of its own. MODEL is a .hcsp or a Minibex file.
#include <cstdio>
#include <fstream>
#include <sstream>

#include "tests/verifier/certificates.h"
#include "tests/verifier/reader.h"

namespace {

std::string text_of(const std::string& path) {
  const std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

int verify(const std::string& model, const std::string& result) {
  using namespace hcsp::verifier;
  const System system = model.ends_with(".hcsp") ? read_hcsp(text_of(model)) : read_minibex(text_of(model));
  const std::vector<Claim> claims = claims_of(system, text_of(result));
  std::size_t certified = 0;
  for (const Claim& claim : claims) certified += claim.certificate == "none" ? 0 : 1;
  const std::vector<std::string> complaints = unconfirmed(system, claims);
  for (const std::string& complaint : complaints) std::printf("%s\n", complaint.c_str());
  std::printf("%s: %zu of %zu certificates confirmed, %zu boxes without\n", model.c_str(),
              certified - complaints.size(), certified, claims.size() - certified);
  return complaints.empty() ? 0 : 1;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) {
    std::fputs("usage: verify_certificates MODEL RESULT.json\n", stderr);
    return 2;
  }
  try {
    return verify(arguments[1], arguments[2]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", arguments[1], error.what());
    return 1;
  }
}
