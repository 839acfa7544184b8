#!/usr/bin/env bash
# Creates docs/images/room_lines_light.png and room_lines_dark.png, the pictures of the README: the
# map lines of a synthetic room with the trajectory, taken from the report of a replay.
#
#   docs/images/make_images.sh [MSC_VO [REPORT]]
#
# MSC_VO: the command, by default build/apps/msc_vo. REPORT: a report.html; without it a room is
# rendered and replayed, which takes some minutes. Needs rsvg-convert (Debian: librsvg2-bin).
set -euo pipefail
cd "$(dirname "$0")/../.."
msc_vo=${1:-build/apps/msc_vo}
report=${2:-}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

if [[ -z $report ]]; then
  "$msc_vo" synthesize "$work/room" --scene room --frames 260 --noise kinect
  "$msc_vo" replay "$work/room" --output "$work/out"
  report=$work/out/report.html
fi

# Writes the scene view of the report as a stand-alone SVG. The variables of the style sheet are
# replaced by their values, because librsvg does not support them.
extract_scene() {
  python3 - "$report" "$1" <<'PYTHON'
import re
import sys

report, theme = sys.argv[1:]
page = open(report, encoding="utf-8").read()
style = re.search(r"<style>(.*?)</style>", page, re.DOTALL).group(1)
light, dark = (dict(re.findall(r"(--[\w-]+): (#\w+)", block))
               for block in re.findall(r":root \{(.*?)\}", style, re.DOTALL)[:2])
colors = {**light, **dark} if theme == "dark" else light
rules = re.findall(r"^(?:svg |\.)[^{]*\{[^}]*\}(?: *\.[^{]*\{[^}]*\})*", style, re.MULTILINE)
css = re.sub(r"var\((--[\w-]+)\)", lambda match: colors[match.group(1)], "\n".join(rules))
svg = re.search(r'<svg viewBox="0 0 (\d+) (\d+)"[^>]*aria-label="Map lines and trajectory in '
                r'perspective">.*?</figure>', page, re.DOTALL)
width, height = svg.group(1, 2)
body = svg.group().replace("</figure>", "").replace(
    "<svg ", f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" ', 1)
background = f'<rect width="{width}" height="{height}" fill="{colors["--paper"]}"/>'
font = "svg text { font-family: sans-serif; }"
opening, rest = body.split(">", 1)
print(f"{opening}><style>{css}\n{font}</style>{background}{rest}")
PYTHON
}

for theme in light dark; do
  extract_scene "$theme" >"$work/$theme.svg"
  rsvg-convert --zoom 1.2 "$work/$theme.svg" --output "docs/images/room_lines_$theme.png"
done
