// SPDX-License-Identifier: MIT
/// What Boost calls in place of throwing, where there are no exceptions: rationals of the tests never fail.
#include <boost/throw_exception.hpp>

#if defined(BOOST_NO_EXCEPTIONS)

#include <cstdio>
#include <cstdlib>

namespace boost {

void throw_exception(const std::exception& error) {
  std::fprintf(stderr, "Boost: %s\n", error.what());
  std::abort();
}
void throw_exception(const std::exception& error, const source_location& /*where*/) { throw_exception(error); }

}  // namespace boost

#endif
