#include <fmt/format.h>

#include "app/commands.h"
#include "pipeline/describe.h"
#include "pipeline/style_file.h"

namespace dstylize::app {

void list_styles(const Arguments& arguments) {
    if (arguments.names.size() > 1)
        throw Error(ErrorCode::bad_usage, arguments.names[1], "is one name too many", "write dstylize styles NAME");
    if (arguments.fields)
        print(fields_description());
    else if (arguments.names.empty())
        print(styles_description());
    else {
        Style style = load_style(arguments.names[0]);
        print(style_description(style));
    }
}

}  // namespace dstylize::app
