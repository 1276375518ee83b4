#include <fmt/format.h>

#include <cstdlib>

#include "app/commands.h"
#include "pipeline/describe.h"
#include "pipeline/outputs.h"
#include "pipeline/style_file.h"

namespace dstylize::app {
namespace {

void copy_style(const Arguments& arguments) {
    if (arguments.names.size() != 2)
        throw Error(ErrorCode::bad_usage, "--copy", "needs a style and a file",
                    "write dstylize styles --copy vine mine.toml");
    copy_style_file(arguments.names[0], user_style_folder(), arguments.names[1], arguments.force);
}

}  // namespace

std::filesystem::path user_style_folder() {
    const char *config = std::getenv("XDG_CONFIG_HOME"), *home = std::getenv("HOME");
    if (config && *config == '/') return std::filesystem::path(config) / "dstylize/styles";
    return home && *home ? std::filesystem::path(home) / ".config/dstylize/styles" : std::filesystem::path();
}

void list_styles(const Arguments& arguments) {
    if (arguments.copy) return copy_style(arguments);
    if (arguments.names.size() > 1)
        throw Error(ErrorCode::bad_usage, arguments.names[1], "is one name too many", "write dstylize styles NAME");
    if (arguments.fields)
        print(fields_description());
    else if (arguments.names.empty())
        print(styles_description(user_style_folder()));
    else {
        Style style = load_style(arguments.names[0], {}, user_style_folder());
        print(style_description(style));
    }
}

}  // namespace dstylize::app
