// Before version 3 the name of a texture inside `texture` replaces all that precedes it, at any place.
#version 1.0;
camera { location <0, 0, -12> direction <0, 0, 1.5> look_at <0, 0, 0> }
light_source { <-10, 10, -20> color rgb <1, 1, 1> }
#declare Plain = texture { ambient 0.4 color red 0.8 green 0.2 }
#declare Tiles = texture { checker color red 1 color blue 1 scale <0.5 0.5 0.5> ambient 0.3 phong 0.8 }
sphere { <-3, 1.5, 0>, 1.2 texture { Plain Tiles } }
sphere { <0, 1.5, 0>, 1.2 texture { Tiles scale <2 2 2> Plain } }
sphere { <3, 1.5, 0>, 1.2 texture { reflection 0.3 color green 1 Tiles scale <0.5 0.5 0.5> } }
sphere { <-3, -1.5, 0>, 1.2 texture { ambient 0.9 bumps 0.6 Plain phong 1 } }
sphere { <0, -1.5, 0>, 1.2 texture { Plain color blue 1 Plain Tiles diffuse 0.3 } }
sphere { <3, -1.5, 0>, 1.2 texture { color blue 0.5 Plain } }
