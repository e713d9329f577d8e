#pragma once

#include <string>

namespace earshot::watch {

/// Opens a page in the browser that a person has chosen (xdg-open), where there is a desktop; does nothing elsewhere, and waits for
/// nothing.
void open_in_browser(const std::string& url);

}  // namespace earshot::watch
