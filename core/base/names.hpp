#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace perifrac {

/// What a user wrote, fit for one line of an error message: shortened, no control bytes.
std::string printable(std::string_view text);

/// As printable, between quotes.
std::string in_quotes(std::string_view text);

/// `a, b, c`, cut after eight.
std::string list_names(const std::vector<std::string>& names);

/// `expected one of: a, b, c` and `; did you mean 'b'?` where one is near.
std::string expected_one_of(const std::vector<std::string>& known, std::string_view written);

/// The known name that takes the fewest typing slips (insert, drop, change, swap a letter) to get
/// to; empty if none is near.
std::string nearest_name(std::string_view written, const std::vector<std::string>& known);

}  // namespace perifrac
