# Part of ./run: ./run demo, figures, bench, web, docs and mirror.

DEMO=(run assets/plate_1d.glb --stroke sweep --seconds 5)

# Builds only the tool, with few packages; an existing configuration with tests is kept.
demo() {
    need_packages "${DEMO_PACKAGES[@]}"
    mkdir -p build/demo
    [ -f build/release/CMakeCache.txt ] || configure release -DBUILD_TESTING=OFF
    echo 'run: building the tool'
    with_progress 'building the tool' build/release.log cmake --build build/release --target knurl_tool feel_scene \
        touch_grating || { tail -n 60 build/release.log >&2; exit 1; }
    echo "run: build/release/knurl ${DEMO[*]} --out build/demo/sweep.csv"
    build/release/knurl "${DEMO[@]}" --out build/demo/sweep.csv --pretty >build/demo/sweep.json
    /usr/bin/python3 samples/draw_run.py build/demo/sweep.csv build/demo/sweep.svg
    echo 'run: see build/demo/sweep.svg; the ticks are in build/demo/sweep.csv, a summary in build/demo/sweep.json'
    [ -x build/release/knurl_study ] || echo 'run: this build/release/knurl has no --view, Falcon, raw HID, metrics and study: ./run test installs what they need, and builds them'
}

# usage: figures [--check]. assets/pictures/NAME.data summarises the data of NAME.png; --check draws nothing and lists
# changed data. bench.png and the times in tradeoff.png are left out, because they depend on the machine.
figures() {
    local name stale=0
    case ${1:-} in
    '' | --check | --update) ;;
    *) echo "run: figures: expected --check, --update or nothing, found '$1'" >&2; exit 2 ;;
    esac
    need_packages "${BUILD_PACKAGES[@]}" "${PLOT_PACKAGES[@]}" valgrind
    build release knurl_tool knurl_study_tool knurl_tick_row
    mkdir -p build/study build/figures
    # usage: picture NAME PLOTTER PLOTTED MORE...: draws it and writes its data, or checks them
    picture() {
        local drawn=(/usr/bin/python3 -B samples/study/drawn.py)
        if [ "$how" = --check ]; then
            "${drawn[@]}" --check "assets/pictures/$1.data" "${@:3}" || stale=1
        else
            /usr/bin/python3 "samples/study/$2" "$3" --out "$out/$1.png" ${title:+--title "$title"}
            "${drawn[@]}" "$out/$1.data" "${@:3}"
        fi
    }
    local how=${1:-} out=build/figures title='bandlimited, a simulated hand: to 240 mm/s over 1 mm'
    [ "$how" != --update ] || out=assets/pictures
    echo "run: knurl ${DEMO[*]} --fast"
    build/release/knurl "${DEMO[@]}" --fast --out build/study/sweep.csv --wav build/study/sweep.wav >build/study/sweep.json
    picture sweep plot.py build/study/sweep.csv
    title=
    awk 'BEGIN { print "t,x,y,z"; for (i = 0; i <= 700; i++) # at 50 mm/s, 1 mm deep
        printf "%.3f,%.5f,%.5f,0\n", i / 1000, 0.00005 * i - 0.0175, i < 100 ? -0.00001 * i : -0.001 }' >build/study/moving.csv
    build/release/knurl run assets/plate_1d.glb --trace build/study/moving.csv --exact --fast --out build/study/moved.csv >build/study/moved.json
    /usr/bin/python3 samples/study/moving.py build/study/moved.csv build/figures/moving.svg
    if [ "$how" = --check ]; then
        cmp build/figures/moving.svg assets/pictures/moving.svg || stale=1
    elif [ "$how" = --update ]; then
        cp build/figures/moving.svg assets/pictures/
    fi
    picture sound sound.py build/study/sweep.{csv,wav}
    for name in signals coverage temporal device gratings preferences tradeoff velocity transitions smooth even stability failures; do
        echo "run: study $name"
        build/release/knurl study "$name" --out build/study
        picture "$name" figures.py "build/study/$name".{json,csv}
    done
    picture speed_accuracy figures.py build/study/speed_accuracy.json build/study/tradeoff.csv # from the tradeoff
    for name in stability_methods stability_amplitudes stability_effects; do # from the same study
        picture "$name" figures.py "build/study/$name".{json,csv}
    done
    if [ "$how" = --check ]; then
        [ $stale -eq 0 ] || { echo 'run: some pictures are out of date, see above' >&2; return 1; }
        echo 'run: the pictures show what the code does'
        return 0
    fi
    /usr/bin/python3 samples/study/dark.py "$out"/{sweep,stability{,_methods,_amplitudes,_effects},speed_accuracy,smooth,even,signals,coverage,temporal,device}.png \
        "$out"/{gratings,preferences,tradeoff,transitions,velocity}.png # those on pages
    [ "$how" != --update ] || cp build/study/failures.md samples/study/failures.md
    echo "run: the numbers are in build/study, the pictures and what they were drawn from in $out"
}

bench() {
    need_packages "${BUILD_PACKAGES[@]}" "${PLOT_PACKAGES[@]}"
    build release knurl_tool knurl_study_tool
    mkdir -p build/study
    echo "run: build/release/knurl bench --json"
    build/release/knurl bench --json >build/study/bench.json.part
    mv build/study/bench.json.part build/study/bench.json
    /usr/bin/python3 samples/study/figures.py build/study/bench.json --out assets/pictures/bench.png
    /usr/bin/python3 samples/study/dark.py assets/pictures/bench.png
    /usr/bin/python3 samples/study/figures.py samples/bench/results/bench_history.json --out assets/pictures/bench_history.png
    /usr/bin/python3 samples/study/dark.py assets/pictures/bench_history.png
    echo "run: study half_cycles"
    build/release/knurl study half_cycles --out build/study
    echo "run: the numbers are in build/study, the picture is assets/pictures/bench.png"
}

# Builds the page, with its dependencies.
web() {
    local begin=$SECONDS code=0
    need_packages "${WEB_PACKAGES[@]}"
    need_npm
    mkdir -p build
    with_progress 'building the page' build/web.log samples/web/build.sh "$PWD/build/web-work" "$PWD/build/web" || code=$?
    if [ $code -ne 0 ]; then
        tail -n 20 build/web.log >&2
        echo 'run: web: the page could not be built, see above' >&2
        exit $code
    fi
    echo "run: the page is in build/web, after $((SECONDS - begin)) s; to see it: python3 -m http.server --directory build/web 8000"
}

# usage: docs [page]: with the page of build/web, if it is built. A release is without, so that a clone gives the same bytes
docs() {
    need_packages python3-venv
    need_python docs-venv docs/site/requirements.txt
    /usr/bin/python3 -B tests/docs/check.py
    rm -rf build/docs
    build/docs-venv/bin/python -B docs/site/pages.py build/docs/pages
    PYTHONDONTWRITEBYTECODE=1 build/docs-venv/bin/sphinx-build -q -W --keep-going -j auto -c docs/site -d build/docs/work build/docs/pages build/docs/html
    if [ "${1:-}" = page ] && [ -f build/web/main.js ]; then # the links to the page go there
        cp -r build/web build/docs/html/page
        sed -i 's|href="http://127.0.0.1:8000/#|href="../page/index.html#|g' build/docs/html/docs/*.html
    fi
    /usr/bin/python3 -B tests/docs/site.py build/docs/html
    echo 'run: the site is build/docs/html/index.html'
}

mirror() {
    need_packages "${BUILD_PACKAGES[@]}"
    need_python mirror-venv bindings/unity/native/requirements.txt
    build/mirror-venv/bin/python bindings/unity/native/mirror.py
    build/mirror-venv/bin/python -B scripts/api.py build/api.json
    echo 'run: all that the headers declare is in build/api.json'
}
