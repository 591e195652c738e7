// Names for what the parameter file speaks of. A surface is found by the box that it fits into.
Physical Volume("lug") = {lug};
Physical Volume("pin") = {pin};
Physical Surface("pull") = Surface In BoundingBox{60-e, -20-e, -6-e, 60+e, 20+e, 6+e};
Physical Surface("bore") = Surface In BoundingBox{-10.025-e, -10.025-e, -6-e, 10.025+e, 10.025+e, 6+e};
Physical Surface("ends") = {Surface In BoundingBox{-11, -11, -16-e, 11, 11, -16+e}, Surface In BoundingBox{-11, -11, 16-e, 11, 11, 16+e}};
all() = Boundary{ Volume{pin}; };
For i In {0:#all()-1}
  b() = BoundingBox Surface{all(i)};
  If (b(2) < -15 && b(5) > 15)
    Physical Surface("shank") = all(i);
  EndIf
EndFor
