// Steps of height fields of functions: grey pigments keep theirs, colours are cut after their grey is rounded.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { orthographic location <8, 6, -5> direction z right 16*x up 12*y }
#macro Show(Color, Left)
  #local Field = height_field {
    function 9, 13 { pigment { bozo color_map { [0 rgb 0] [1 rgb Color / 65535] } scale 0.2 } }
  };
  #local Normal = <0, 0, 0>;
  #for (Row, 0, 11)
    #for (Column, 0, 7)
      #local Hit = trace(Field, <(Column + 1e-9) / 8, 2, (Row + 1e-9) / 12>, -y, Normal);
      box {
        <Left + Column, Row, 0>, <Left + Column + 1, Row + 1, 1>
        pigment { rgb mod(floor(Hit.y * 65536 + 0.5), 6) / 5 } finish { ambient 1 diffuse 0 }
      }
    #end
  #end
#end
Show(30, 0)
Show(<10000, 40000, 20000>, 8)
