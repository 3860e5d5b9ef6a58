// An actor that fills instanced meshes with the blades of a field of grass.
#pragma once

#include "CoreMinimal.h"
#include "GameFramework/Actor.h"

#include "SwardGrass.generated.h"

class UHierarchicalInstancedStaticMeshComponent;
class UStaticMesh;

UCLASS()
class ASwardGrass : public AActor {
    GENERATED_BODY()

public:
    ASwardGrass();

    /** A .sward file. */
    UPROPERTY(EditAnywhere, Category = "Sward")
    FFilePath Field;

    /** A blade: 1 cm high along Z, 1 cm wide along X, leaning to +Y. One for each species, or one for all. */
    UPROPERTY(EditAnywhere, Category = "Sward")
    TArray<UStaticMesh*> Blades;

    /** Blades fade out between these distances [cm]. */
    UPROPERTY(EditAnywhere, Category = "Sward")
    FInt32Interval FadeDistance = FInt32Interval(6000, 9000);

    UPROPERTY(EditAnywhere, Category = "Sward")
    bool bCastsShadows = false;

    /** Reads the field anew. */
    UFUNCTION(CallInEditor, Category = "Sward")
    void Load();

protected:
    virtual void BeginPlay() override;

private:
    UPROPERTY(Transient)
    TArray<UHierarchicalInstancedStaticMeshComponent*> Grown;
};
