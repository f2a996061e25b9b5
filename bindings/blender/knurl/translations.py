"""The panel's words in other languages, by the English ones; formats keep their fields. Another language is another dictionary in
LANGUAGES. SPDX-License-Identifier: MIT"""
import bpy

GERMAN = {
    "A force-feedback device feels ridges here": "Ein Force-Feedback-Gerät fühlt hier Rillen",
    "Ridges (mm)": "Rillen (mm)",
    "From ridge to ridge along u; 0: a smooth surface": "Von Rille zu Rille entlang u; 0: eine glatte Fläche",
    "Across (mm)": "Quer (mm)",
    "From ridge to ridge along v, which makes a grid; 0: no ridges":
        "Von Rille zu Rille entlang v, was ein Gitter ergibt; 0: keine Rillen",
    "Depth (mm)": "Tiefe (mm)",
    "From the bottom of a groove to the top of a ridge": "Vom Grund bis zum Kamm einer Rille",
    "Stiffness (N/m)": "Steifigkeit (N/m)",
    "Of the wall; a Touch holds some 800 N/m": "Der Wand; ein Touch hält etwa 800 N/m",
    "Friction": "Reibung",
    "Coulomb coefficient": "Coulombscher Reibungskoeffizient",
    "Damping (N s/m)": "Dämpfung (N s/m)",
    "Along the normal": "Entlang der Normalen",
    "Direction": "Richtung",
    "Turns the ridges about the normal": "Dreht die Rillen um die Normale",
    "Axis": "Achse",
    "Direction across the ridges in the object's space; 0, 0, 0: by its UVs":
        "Richtung quer zu den Rillen im Raum des Objekts; 0, 0, 0: nach seinen UVs",
    "Coordinates": "Koordinaten",
    "How ridges are placed": "Wie die Rillen liegen",
    "Method": "Verfahren",
    "How ridges are played": "Wie Rillen wiedergegeben werden",
    "Faceted": "Facettiert",
    "Felt as its triangles, though the mesh is shaded smooth":
        "Als Dreiecke gefühlt, obwohl das Netz glatt schattiert ist",
    "Show Ridges": "Rillen zeigen",
    "Draws the crests in the 3D view, where they are felt": "Zeichnet die Kämme in die 3D-Ansicht, wo sie gefühlt werden",
    "Everyday Material": "Alltägliches Material",
    "Copy to Selected": "Auf Ausgewählte kopieren",
    "Ridges from Texture": "Rillen aus Textur",
    "Feel": "Fühlen",
    "Ridges finer than two of a Touch's counts (0.11 mm)": "Rillen feiner als zwei Schritte eines Touch (0,11 mm)",
    "Stiffer than a Touch can hold (800 N/m)": "Steifer, als ein Touch halten kann (800 N/m)",
    "UVs stretch: ridges are {least:.2g} to {most:.2g} mm apart, uneven on {share:.2g} % of the area":
        "UVs sind verzerrt: Rillen im Abstand von {least:.2g} bis {most:.2g} mm, ungleich auf {share:.2g} % der Fläche",
    "UVs have no area: ridges follow positions; unwrap, or give an axis":
        "UVs haben keine Fläche: Rillen folgen der Lage; abwickeln oder eine Achse angeben",
    "No UVs: ridges follow positions; give an axis to choose their direction":
        "Keine UVs: Rillen folgen der Lage; eine Achse gibt ihre Richtung an",
    "Many ridges: one of {step} is drawn": "Viele Rillen: eine von {step} ist gezeichnet",
    "Ridges are not drawn: {count} triangles, more than {most}":
        "Rillen sind nicht gezeichnet: {count} Dreiecke, mehr als {most}",
    "Modifiers are felt if the export applies them": "Modifikatoren werden gefühlt, wenn der Export sie anwendet",
}

LANGUAGES = {"de_DE": GERMAN, "de": GERMAN}  # versions of Blender call it by one or the other


def register():
    bpy.app.translations.register(__package__, {
        locale: {(context, english): other for english, other in words.items() for context in ("*", "Operator")}
        for locale, words in LANGUAGES.items()})


def unregister():
    bpy.app.translations.unregister(__package__)
