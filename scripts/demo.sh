#!/bin/bash
# demo.sh [OUT_FOLDER]: the figures of Segal et al. 1992 re-made with the scenes of examples/scenes, and the
# same lights on a model of Debian's assimp-testmodels.
set -eu
cd "$(dirname "$0")/.."
build=${LATERNA_BUILD:-build/release}
out=${1:-out}
scenes=examples/scenes
duck=/usr/share/assimp/models/Collada/duck.dae
started=$(date +%s%N)
mkdir -p "$out"

laterna() { "$build/apps/laterna" "$@"; }
figure() { "$build/examples/side_by_side" "$@"; }
picture=(--camera front --size 1280x853 --samples 8)

# Figure 3: a slide, and the slide thrown on a scene.
laterna render $scenes/stage.glb --rig $scenes/stage.json "${picture[@]}" -o "$out/figure3_scene.png"
figure "$out/figure3.png" $scenes/lake.png "$out/figure3_scene.png"

# Figure 4: what the light sees as depth, its intensity map, and both at work.
laterna depthmap $scenes/table.glb --rig $scenes/table.json --light star -o "$out/figure4_shadow_map.png"
laterna render $scenes/table.glb --rig $scenes/table.json "${picture[@]}" -o "$out/figure4_result.png"
figure "$out/figure4.png" "$out/figure4_shadow_map.png" $scenes/star.png "$out/figure4_result.png"

# The same slide and the same star on a model that was made by others.
laterna render $scenes/room.glb $duck --rig $scenes/stage.json "${picture[@]}" -o "$out/model_slide.png" 2> >(grep -v "are left out" >&2)
laterna render $scenes/room.glb $duck --rig $scenes/table.json "${picture[@]}" -o "$out/model_spotlight.png" 2> >(grep -v "are left out" >&2)

milliseconds=$((($(date +%s%N) - started) / 1000000))
echo
echo "Made in $((milliseconds / 1000)).$(printf %03d $((milliseconds % 1000))) s:"
while read -r file what; do echo "  $out/$file   $what"; done <<TABLE
figure3.png           Segal et al. 1992, figure 3: a slide, and the slide on a scene
figure3_scene.png     the lit scene by itself
figure4.png           figure 4: shadow map, spotlight intensity map, both at work
figure4_shadow_map.png  the shadow map alone: near is light, far is dark
figure4_result.png    the lit scene by itself
model_slide.png       the same slide on a model from assimp-testmodels
model_spotlight.png   the same spotlight on it
TABLE
