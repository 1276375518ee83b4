#include "app/commands.h"
#include "app/interrupt.h"
#include "app/requests.h"

namespace dstylize::app {

void write(const Arguments& arguments) {
    const RunRequest request = write_request(arguments);
    refuse_folder(request.input);
    Interrupt interrupt;
    PictureCodec codec(codec_options(arguments));
    run_and_report(request, arguments, codec, interrupt);
}

}  // namespace dstylize::app
