#!/bin/bash
# Rebuilds every picture in samples/. Usage: make.sh [name ...]   (default: all)
# Debian packages: povray povray-includes imagemagick g++ python3 fonts-dejavu-core
set -euo pipefail
cd "$(dirname "$0")"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

png=(-strip -define png:compression-level=9 -define png:compression-filter=5)
small=(-blur 0x0.4 -dither FloydSteinberg -colors 256)  # for busy pictures: a palette

pov() {  # name, width, height, further ImageMagick options
    povray "+I$1.pov" "+O$work/$1.png" "+W$2" "+H$3" +A0.15 +AM2 +R3 +WT1 -D -GA >"$work/log" 2>&1 ||
        { cat "$work/log" >&2; return 1; }
    convert "$work/$1.png" -depth 8 "${@:4}" "${png[@]}" "../$1.png"
}
march() {  # name, width
    g++ -std=c++17 -O2 -ffp-contract=off -o "$work/$1" "$1.cpp"
    "$work/$1" "$2" | convert ppm:- "${@:3}" "${png[@]}" "../$1.png"
}

portrait()   { march portrait 768 "${small[@]}"; }
cat_()       { march cat 880 "${small[@]}"; }
still-life() { pov still-life 960 720; }
sailboat()   { pov sailboat 960 720 "${small[@]}"; }
house()      { pov house 960 720 "${small[@]}"; }
sky()        { pov sky 960 640; }
stone()      { python3 stone.py 900 600 | convert pgm:- -blur 0x0.5 "${png[@]}" ../stone.png; }
letters()    { convert -size 1200x500 xc:black -fill white -font DejaVu-Sans-Bold -pointsize 360 \
                   -gravity center -annotate +0+0 Hello -colorspace gray "${png[@]}" ../letters.png; }

[ $# -gt 0 ] || set -- portrait still-life sailboat cat house letters sky stone
for name in "$@"; do
    echo "$name" >&2
    case $name in cat) cat_ ;; *) "$name" ;; esac
done
