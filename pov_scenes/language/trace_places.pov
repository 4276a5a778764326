// Shows that trace finds points and normals on a torus, and that a loop can stand things there.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 3, -5> look_at 0 }
light_source { <5, 8, -6>, 1 }
#declare Ground = torus { 1.2, 0.5 pigment { rgb <0.4, 0.5, 0.3> } }
object { Ground }
#for (I, -8, 8)
  #for (K, -8, 8)
    #declare Normal = <0, 0, 0>;
    #declare Place = trace(Ground, <I * 0.2, 5, K * 0.2>, -y, Normal);
    #if (vlength(Normal) != 0)
      cone { Place, 0.05, Place + 0.3 * Normal, 0 pigment { rgb 0.5 + 0.5 * Normal } }
    #end
  #end
#end
